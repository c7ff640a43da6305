#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <memory>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/markup.h"
#include "antigrasp/core/spool.h"
#include "antigrasp/datasets/npy_grids.h"
#include "antigrasp/datasets/npy_text.h"
#include "antigrasp/datasets/vti_header.h"
#include "antigrasp/mesh/text_scanner.h"

// Grids as VTK image data: an image whose points have one array of scalars a grid.
namespace antigrasp {
namespace {

constexpr const char* kVtiFormat = "antigrasp.sdf";

// Every array, unpacked to float32, in a file that goes with this.
class VtiGrids {
 public:
  explicit VtiGrids(const std::filesystem::path& path)
      : path_(path.string()),
        spool_(std::make_shared<Spool>(std::filesystem::temp_directory_path() / "antigrasp-vti")) {
    std::ifstream file(path, std::ios::binary);
    header_ = ReadVtiHeader(
        &file, path_, [&](const VtiHeader& header, const VtiArray& array, const std::string& text) {
          AddInline(header, array, text);
        });
    const auto in_line = places_.size();
    if (in_line > 0 && in_line < header_.arrays.size()) {
      throw InputError("arrays both in the XML and appended", path_, "all of one format");
    }
    const std::uint64_t size = std::filesystem::file_size(path);
    for (const VtiArray& array : header_.arrays) {
      if (array.format != "appended") continue;
      VtiBytes bytes(
          [&, begin = header_.appended_at + array.offset](std::uint64_t at, std::size_t count) {
            if (begin + at >= size) return std::string();
            std::string read(std::min<std::uint64_t>(count, size - begin - at), '\0');
            file.clear();
            file.seekg(static_cast<std::streamoff>(begin + at));
            file.read(read.data(), static_cast<std::streamsize>(read.size()));
            read.resize(static_cast<std::size_t>(file.gcount()));
            return read;
          },
          header_.appended_base64, path_);
      Unpack(header_, array, &bytes);
    }
  }

  const VtiHeader& header() const { return header_; }
  std::function<void(int, std::span<float>)> Reading() const {
    return [spool = spool_, places = places_](int i, std::span<float> values) {
      spool->Read(places[static_cast<std::size_t>(i)], values.data(), values.size_bytes());
    };
  }

 private:
  static std::uint64_t ValuesOf(const VtiHeader& header) {
    const auto n = static_cast<std::uint64_t>(header.n);
    return n * n * n;
  }
  void Keep(std::string_view bytes, std::size_t float_size) {
    std::vector<float> values(bytes.size() / float_size);
    NpyToFloats(bytes, float_size, values);
    spool_->Append(values.data(), values.size() * sizeof(float));
    kept_ += values.size() * sizeof(float);
  }
  void Unpack(const VtiHeader& header, const VtiArray& array, VtiBytes* bytes) {
    places_.push_back(kept_);
    std::string rest;  // blocks need not end where values do
    UnpackVtiArray(bytes, header.packing, ValuesOf(header) * array.float_size, path_,
                   [&](std::string_view piece) {
                     rest += piece;
                     const std::size_t whole = rest.size() - rest.size() % array.float_size;
                     Keep(std::string_view(rest).substr(0, whole), array.float_size);
                     rest.erase(0, whole);
                   });
  }
  void AddInline(const VtiHeader& header, const VtiArray& array, const std::string& text) {
    if (array.format == "binary") {
      VtiBytes bytes(
          [&](std::uint64_t at, std::size_t size) {
            return at >= text.size() ? std::string() : text.substr(at, size);
          },
          true, path_);
      return Unpack(header, array, &bytes);
    }
    places_.push_back(kept_);
    std::vector<float> values;
    std::string_view rest(text);
    for (std::string_view word = TakeWord(&rest); !word.empty(); word = TakeWord(&rest)) {
      values.push_back(static_cast<float>(ParseNumber(word).value_or(NAN)));
    }
    if (values.size() != ValuesOf(header)) {
      throw InputError(std::to_string(values.size()) + " values", path_,
                       std::to_string(ValuesOf(header)) + " of its image");
    }
    spool_->Append(values.data(), values.size() * sizeof(float));
    kept_ += values.size() * sizeof(float);
  }

  std::string path_;
  std::shared_ptr<Spool> spool_;
  VtiHeader header_;
  std::vector<std::uint64_t> places_;
  std::uint64_t kept_ = 0;
};

double NumberSaid(const VtiHeader& header, const std::string& name) {
  const auto found = header.says.find(name);
  std::string_view text = found == header.says.end() ? "0" : std::string_view(found->second);
  return ParseNumber(TakeWord(&text)).value_or(NAN);
}

std::string TextSaid(const VtiHeader& header, const std::string& name) {
  const auto found = header.says.find(name);
  return found == header.says.end() ? "" : found->second;
}

void ReadSayings(const VtiHeader& header, const std::string& path, ForeignGrids* grids) {
  grids->spacing = header.spacing;
  if (TextSaid(header, "format") != kVtiFormat) return;
  if (TextSaid(header, "sign") != "positive inside") {
    throw InputError("sign = " + Quoted(TextSaid(header, "sign")), path,
                     "sign = \"positive inside\"");
  }
  grids->says = true;
  grids->origin = Eigen::Vector3d(header.origin[0], header.origin[1], header.origin[2]);
  grids->info.kind = TextSaid(header, "kind");
  grids->info.provenance = TextSaid(header, "provenance");
  const std::string said = TextSaid(header, "seed");
  std::string_view rest(said);
  const std::string_view seed = TakeWord(&rest);
  std::from_chars(seed.data(), seed.data() + seed.size(), grids->info.seed);
  grids->info.truncation = NumberSaid(header, "truncation");
  grids->info.side = NumberSaid(header, "side");
  if (!(grids->info.truncation >= 0.0 && std::isfinite(grids->info.truncation) &&
        grids->info.side >= 0.0 && std::isfinite(grids->info.side))) {
    throw InputError("truncation or side that is no length", path, "lengths");
  }
}

class VtiSink : public GridSink {
 public:
  explicit VtiSink(const std::filesystem::path& path)
      : target_(path), values_(path.string() + ".values") {}

  void Begin(const ShapeSet& about, std::size_t /*count*/, const SdfGrid& first) override {
    first_ = first;
    fields_ = Field("format", kVtiFormat) + Field("sign", "positive inside") +
              Field("unit", "side of the unit cube") + Field("kind", about.kind) +
              Field("seed", std::to_string(about.seed), "UInt64") +
              Field("truncation", FormatDouble(about.truncation), "Float64") +
              (about.side > 0.0 ? Field("side", FormatDouble(about.side), "Float64") : "") +
              Field("provenance", about.provenance);
  }
  void Add(const std::vector<float>& values) override {
    values_.Append(values.data(), values.size() * sizeof(float));
  }
  void Commit(const std::vector<std::string>& names) override {
    const std::uint64_t nodes = static_cast<std::uint64_t>(first_.n) *
                                static_cast<std::uint64_t>(first_.n) *
                                static_cast<std::uint64_t>(first_.n);
    const std::uint64_t bytes = nodes * sizeof(float);
    target_.Append(Opening(names));
    for (std::size_t i = 0; i < names.size(); ++i) {
      target_.Append("        <DataArray type=\"Float32\" Name=\"" + Attribute(names[i]) +
                     "\" format=\"appended\" offset=\"" +
                     std::to_string(i * (bytes + sizeof bytes)) + "\"/>\n");
    }
    target_.Append(
        "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n   "
        "_");
    std::string values(bytes, '\0');
    for (std::size_t i = 0; i < names.size(); ++i) {
      target_.Append({reinterpret_cast<const char*>(&bytes), sizeof bytes});
      values_.Read(i * bytes, values.data(), bytes);
      target_.Append(values);
    }
    target_.Append("\n  </AppendedData>\n</VTKFile>\n");
    target_.Commit();
  }

 private:
  std::string Opening(const std::vector<std::string>& names) const {
    const std::string last = std::to_string(first_.n - 1);
    const std::string extent = "0 " + last + " 0 " + last + " 0 " + last;
    const std::string spacing = FormatDouble(first_.spacing);
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n  <ImageData WholeExtent=\"" +
        extent + "\" Origin=\"" + FormatDouble(first_.origin.x()) + " " +
        FormatDouble(first_.origin.y()) + " " + FormatDouble(first_.origin.z()) + "\" Spacing=\"" +
        spacing + " " + spacing + " " + spacing + "\">\n    <FieldData>\n" + fields_ +
        "    </FieldData>\n    <Piece Extent=\"" + extent + "\">\n      <PointData";
    if (!names.empty()) text += " Scalars=\"" + Attribute(names[0]) + "\"";
    return text + ">\n";
  }
  // XML has no other control characters than white space, and its text is UTF-8.
  static std::string Attribute(std::string name) {
    for (char& c : name) {
      if (static_cast<unsigned char>(c) < 0x20) c = '?';
    }
    return MarkupEscaped(ValidUtf8(name));
  }
  // Texts are the numbers of their letters, as VTK has them.
  static std::string Field(const std::string& name, const std::string& value,
                           const std::string& type = "String") {
    std::string letters;
    for (const char c : value) {
      letters += std::to_string(static_cast<int>(static_cast<unsigned char>(c))) + " ";
    }
    const bool text = type == "String";
    const std::string element = text ? "Array" : "DataArray";
    return "      <" + element + " type=\"" + type + "\" Name=\"" + name +
           "\" NumberOfTuples=\"1\" format=\"ascii\">" + (text ? letters + "0" : value) + "</" +
           element + ">\n";
  }

  AtomicFile target_;
  Spool values_;
  SdfGrid first_{};
  std::string fields_;
};

}  // namespace

ForeignGrids ReadVtiGrids(const std::filesystem::path& path) {
  RequireFile(path, "VTK image data of grids");
  const VtiGrids file(path);
  const VtiHeader& header = file.header();
  ForeignGrids grids;
  grids.info.format = ShapeFormat::kVti;
  grids.info.count = static_cast<int>(header.arrays.size());
  grids.info.n = header.n;
  ReadSayings(header, path.string(), &grids);
  if (header.arrays.size() == 1 && !grids.says) {
    grids.names = NamesAfterFile(path, 1);  // foreign arrays are called "scalars" and the like
  } else {
    for (const VtiArray& array : header.arrays) grids.names.push_back(array.name);
  }
  grids.read = file.Reading();
  return grids;
}

std::unique_ptr<GridSink> MakeVtiSink(const std::filesystem::path& path) {
  return std::make_unique<VtiSink>(path);
}

}  // namespace antigrasp
