#include "antigrasp/datasets/vti_header.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/grid_files.h"
#include "antigrasp/mesh/text_scanner.h"
#include "antigrasp/mesh/xml_elements.h"

namespace antigrasp {
namespace {

constexpr const char* kWantedImage =
    "VTK image data (.vti): one piece, the same number of points along x, y and z";
constexpr std::string_view kAppended = "<AppendedData";
constexpr std::size_t kFeed = std::size_t{1} << 18, kLongestSaying = std::size_t{1} << 20;
constexpr std::uint64_t kLettersAValue = 64;

std::vector<double> NumbersIn(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view word = TakeWord(&text); !word.empty(); word = TakeWord(&text)) {
    numbers.push_back(ParseNumber(word).value_or(NAN));
  }
  return numbers;
}

// Text of VTK: the numbers of its letters up to a 0.
std::string TextIn(std::string_view codes) {
  std::string text;
  for (const double code : NumbersIn(codes)) {
    if (!(code > 0.0 && code < 256.0)) break;
    text.push_back(static_cast<char>(static_cast<unsigned char>(code)));
  }
  return text;
}

class VtiXml {
 public:
  using InlineText = std::function<void(const VtiHeader&, const VtiArray&, const std::string&)>;
  VtiXml(std::string path, const InlineText& inline_text)
      : path_(std::move(path)), inline_text_(inline_text) {}

  void Start(std::string_view name, const XmlAttributes& attributes) {
    if (depth_++ == 0 && name != "VTKFile") Fail("no VTK file", kWantedImage);
    if (name == "VTKFile") return StartFile(attributes);
    if (name == "ImageData") return StartImage(attributes);
    if (name == "Piece") return StartPiece(attributes);
    if (name == "PointData" || name == "FieldData") section_ = name;
    if (name == "DataArray" || name == "Array") StartArray(attributes);
  }

  void End(std::string_view name) {
    --depth_;
    if (name == "PointData" || name == "FieldData") section_.clear();
    if (!reading_ || (name != "DataArray" && name != "Array")) return;
    if (!saying_.empty()) {
      header_.says[saying_] = saying_is_text_ ? TextIn(text_) : text_;
    } else {
      inline_text_(header_, header_.arrays.back(), text_);
    }
    reading_ = false;
    saying_.clear();
    text_ = {};
  }

  void Text(std::string_view text) {
    if (!reading_) return;
    if (text_.size() + text.size() > most_text_) Fail("an array that is too long", kWantedImage);
    text_ += text;
  }

  VtiHeader Finish() {
    if (pieces_ == 0) Fail("no image", kWantedImage);
    if (header_.arrays.empty()) {
      Fail("no scalar of float32 or float64 at the points", "distances as PointData");
    }
    return std::move(header_);
  }

 private:
  static std::string Value(const XmlAttributes& attributes, const char* name) {
    return std::string(attributes.Find(name).value_or(""));
  }

  void StartFile(const XmlAttributes& attributes) {
    const std::string type = Value(attributes, "type"), order = Value(attributes, "byte_order");
    const std::string compressor = Value(attributes, "compressor");
    if (type != "ImageData") Fail("VTK file of type " + Quoted(type), kWantedImage);
    if (order == "BigEndian") Fail("big-endian numbers", "byte_order LittleEndian");
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
      Fail("packed by " + Quoted(compressor), "zlib or none");
    }
    header_.packing.zlib = !compressor.empty();
    header_.packing.header_size = Value(attributes, "header_type") == "UInt64" ? 8 : 4;
  }

  void StartImage(const XmlAttributes& attributes) {
    extent_ = NumbersIn(Value(attributes, "WholeExtent"));
    const std::vector<double> spacing = NumbersIn(Value(attributes, "Spacing"));
    const std::vector<double> origin = NumbersIn(Value(attributes, "Origin"));
    const std::vector<double> turn = NumbersIn(Value(attributes, "Direction"));
    if (extent_.size() != 6 || spacing.size() != 3 || origin.size() != 3) {
      Fail("an image without extent, spacing or origin", kWantedImage);
    }
    if (!turn.empty() && turn != std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}) {
      Fail("an image with turned axes", "Direction 1 0 0 0 1 0 0 0 1");
    }
    const double nodes = extent_[1] - extent_[0] + 1.0;
    for (std::size_t k = 0; k < 6; k += 2) {
      if (extent_[k + 1] - extent_[k] + 1.0 != nodes || !(nodes >= 1.0 && nodes <= kMostNodes)) {
        Fail("an image that is no cube of 1 to " + std::to_string(kMostNodes) + " points a side",
             kWantedImage);
      }
      header_.origin[k / 2] = origin[k / 2] + spacing[k / 2] * extent_[k];
      const bool same = std::abs(spacing[k / 2] - spacing[0]) <= 1e-6 * std::abs(spacing[0]);
      if (!same || !(spacing[0] > 0.0 && spacing[0] < 1e30) ||
          !std::isfinite(header_.origin[k / 2])) {
        Fail("spacing of the points that differs by the axis or is no length",
             "one spacing along x, y and z");
      }
    }
    header_.n = static_cast<int>(nodes);
    header_.spacing = spacing[0];
  }

  void StartPiece(const XmlAttributes& attributes) {
    if (++pieces_ > 1 || header_.n == 0 || NumbersIn(Value(attributes, "Extent")) != extent_) {
      Fail("an image in several pieces", kWantedImage);
    }
  }

  void StartArray(const XmlAttributes& attributes) {
    const std::string type = Value(attributes, "type"), format = Value(attributes, "format");
    if (section_ == "FieldData") {
      saying_is_text_ = type == "String";
      if (format != "ascii") return;  // of other programs: it says nothing to us
      saying_ = Value(attributes, "Name");
      reading_ = !saying_.empty();
      most_text_ = kLongestSaying;
      return;
    }
    const std::string components = Value(attributes, "NumberOfComponents");
    if (section_ != "PointData" || (type != "Float32" && type != "Float64")) return;
    if (!components.empty() && components != "1") return;
    VtiArray array{Value(attributes, "Name"), type == "Float32" ? 4U : 8U, format, 0};
    if (header_.arrays.size() == kMostGrids) Fail("too many arrays", kWantedImage);
    if (format == "appended") {
      const std::string offset = Value(attributes, "offset");
      const auto [end, code] =
          std::from_chars(offset.data(), offset.data() + offset.size(), array.offset);
      if (code != std::errc() || end != offset.data() + offset.size()) {
        Fail("offset " + Quoted(offset), "a place in the appended data");
      }
    } else if (format == "binary" || format == "ascii") {
      const auto n = static_cast<std::uint64_t>(header_.n);
      reading_ = true;
      most_text_ = n * n * n * kLettersAValue + kLongestSaying;
    } else {
      Fail("format " + Quoted(format), "appended, binary or ascii");
    }
    header_.arrays.push_back(std::move(array));
  }

  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, path_, expected);
  }

  std::string path_;
  const InlineText& inline_text_;
  VtiHeader header_;
  std::vector<double> extent_;
  std::string section_, saying_, text_;
  bool reading_ = false, saying_is_text_ = false;
  std::uint64_t most_text_ = 0;
  int pieces_ = 0, depth_ = 0;
};

// The tag that begins the appended data, up to the '_' before its first byte.
void ReadAppendedTag(std::string_view tag, std::uint64_t at, const std::string& path,
                     VtiHeader* header) {
  const std::size_t close = tag.find('>'), begin = tag.find('_', close);
  if (close == std::string_view::npos || begin == std::string_view::npos) {
    throw InputError("damaged appended data", path, kWantedImage);
  }
  header->appended_base64 = tag.substr(0, close).find("base64") != std::string_view::npos;
  header->appended_at = at + begin + 1;
}

}  // namespace

VtiHeader ReadVtiHeader(std::ifstream* file, const std::string& path,
                        const std::function<void(const VtiHeader& header, const VtiArray& array,
                                                 const std::string& text)>& inline_text) {
  VtiXml image(path, inline_text);
  XmlElements xml(
      path, "",
      [&](std::string_view name, const XmlAttributes& attributes) {
        image.Start(name, attributes);
      },
      [&](std::string_view name) { image.End(name); },
      [&](std::string_view text) { image.Text(text); });
  std::string window;  // what was read and not yet parsed
  std::uint64_t parsed = 0;
  std::string piece(kFeed, '\0');
  for (bool more = true; more;) {
    file->read(piece.data(), static_cast<std::streamsize>(piece.size()));
    window.append(piece.data(), static_cast<std::size_t>(file->gcount()));
    more = file->gcount() > 0;
    const std::size_t tag = window.find(kAppended);
    if (tag != std::string::npos) {  // what follows is not XML
      xml.Feed(std::string_view(window).substr(0, tag));
      file->clear();
      window.erase(0, tag);
      window.resize(window.size() + 4096);
      file->read(window.data() + window.size() - 4096, 4096);
      VtiHeader header = image.Finish();
      ReadAppendedTag(window, parsed + tag, path, &header);
      return header;
    }
    // The tag may begin at the end of what was read.
    const std::size_t keep = more ? std::min(window.size(), kAppended.size()) : 0;
    xml.Feed(std::string_view(window).substr(0, window.size() - keep));
    parsed += window.size() - keep;
    window.erase(0, window.size() - keep);
  }
  xml.Finish();
  return image.Finish();
}

}  // namespace antigrasp
