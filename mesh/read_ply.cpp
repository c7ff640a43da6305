#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/text_scanner.h"
#include "antigrasp/mesh/triangle_strip.h"

namespace antigrasp {
namespace {

constexpr const char* kStrips = "tristrips";

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Scalar type = Scalar::kFloat;
  bool is_list = false;
  Scalar length_type = Scalar::kUint8;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { kAscii, kLittle, kBig };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;
};

Scalar ScalarNamed(std::string_view name, const TextScanner& text) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames{{{"char", "int8"},
                                                                   {"uchar", "uint8"},
                                                                   {"short", "int16"},
                                                                   {"ushort", "uint16"},
                                                                   {"int", "int32"},
                                                                   {"uint", "uint32"},
                                                                   {"float", "float32"},
                                                                   {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Scalar>(i);
  }
  text.Fail("property type " + Quoted(name), "char to uint, float, double, int8 to float64");
}

Encoding EncodingNamed(std::string_view name, const TextScanner& text) {
  if (name == "ascii") return Encoding::kAscii;
  if (name == "binary_little_endian") return Encoding::kLittle;
  if (name == "binary_big_endian") return Encoding::kBig;
  text.Fail("format " + Quoted(name), "ascii, binary_little_endian or binary_big_endian");
}

Property ReadProperty(std::string_view line, const TextScanner& text) {
  Property property;
  std::string_view word = TakeWord(&line);
  if (word == "list") {
    property.is_list = true;
    property.length_type = ScalarNamed(TakeWord(&line), text);
    if (property.length_type >= Scalar::kFloat) text.Fail("list length", "an integer type");
    word = TakeWord(&line);
  }
  property.type = ScalarNamed(word, text);
  property.name = TakeWord(&line);
  return property;
}

Header ReadHeader(TextScanner* text) {
  Header header;
  if (text->NextLine().value_or("") != "ply") text->Fail("no PLY header", "'ply' on line 1");
  bool has_format = false;
  while (const auto line = text->NextLine()) {
    std::string_view rest = *line;
    const std::string_view keyword = TakeWord(&rest);
    if (keyword == "format") {
      header.encoding = EncodingNamed(TakeWord(&rest), *text);
      has_format = true;
    } else if (keyword == "element") {
      const std::string_view name = TakeWord(&rest);
      const auto count = ParseInteger(TakeWord(&rest));
      if (!count || *count < 0) text->Fail("element " + Quoted(name), "a count from 0");
      header.elements.push_back({std::string(name), *count, {}});
    } else if (keyword == "property") {
      if (header.elements.empty()) text->Fail("property outside an element", "'element' first");
      header.elements.back().properties.push_back(ReadProperty(rest, *text));
    } else if (keyword == "end_header") {
      if (!has_format) text->Fail("no format line", "'format ascii 1.0' or a binary one");
      return header;
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      text->Fail("header line " + Quoted(*line), "format, element, property or end_header");
    }
  }
  text->Fail("file ends in the header", "'end_header'");
}

// The values after the header, one by one.
class Values {
 public:
  virtual ~Values() = default;
  virtual double Next(Scalar type) = 0;
  [[noreturn]] virtual void Fail(const std::string& what, const std::string& expected) const = 0;
};

class AsciiValues : public Values {
 public:
  explicit AsciiValues(TextScanner text) : text_(std::move(text)) {}
  double Next(Scalar) override { return text_.NextNumber("a value"); }
  void Fail(const std::string& what, const std::string& expected) const override {
    text_.Fail(what, expected);
  }

 private:
  TextScanner text_;
};

class BinaryValues : public Values {
 public:
  BinaryValues(std::string_view bytes, bool swap, std::string path)
      : rest_(bytes), swap_(swap), path_(std::move(path)) {}

  double Next(Scalar type) override {
    switch (type) {
      case Scalar::kInt8:
        return Take<std::int8_t>();
      case Scalar::kUint8:
        return Take<std::uint8_t>();
      case Scalar::kInt16:
        return Take<std::int16_t>();
      case Scalar::kUint16:
        return Take<std::uint16_t>();
      case Scalar::kInt32:
        return Take<std::int32_t>();
      case Scalar::kUint32:
        return Take<std::uint32_t>();
      case Scalar::kFloat:
        return Take<float>();
      case Scalar::kDouble:
        return Take<double>();
    }
    AG_CHECK(false, "unknown PLY type");
  }
  void Fail(const std::string& what, const std::string& expected) const override {
    throw InputError(what, path_, expected);
  }

 private:
  template <typename T>
  T Take() {
    if (rest_.size() < sizeof(T)) Fail("file ends early", "all elements of the PLY header");
    std::array<char, sizeof(T)> raw;
    std::copy_n(rest_.begin(), sizeof(T), raw.begin());
    if (swap_) std::reverse(raw.begin(), raw.end());
    rest_.remove_prefix(sizeof(T));
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  std::string_view rest_;
  bool swap_;
  std::string path_;
};

// Reads one list; `use` gets every value. A length takes part in nothing but this loop, so that a
// false one runs into the end of the file and not out of memory.
template <typename Use>
void ReadList(const Property& property, Values* values, const Use& use) {
  const double length = values->Next(property.length_type);
  if (!(length >= 0.0) || length != std::floor(length)) {
    values->Fail("list of " + std::to_string(length) + " values", "a length from 0");
  }
  for (double i = 0.0; i < length; i += 1.0) use(values->Next(property.type));
}

void Skip(const Property& property, Values* values) {
  if (property.is_list) {
    ReadList(property, values, [](double) {});
  } else {
    values->Next(property.type);
  }
}

void ReadVertices(const Element& element, Values* values, PolygonSoup* soup) {
  for (std::int64_t i = 0; i < element.count; ++i) {
    Eigen::Vector3d v = Eigen::Vector3d::Zero();
    for (const Property& property : element.properties) {
      const bool is_axis = !property.is_list && property.name.size() == 1 &&
                           property.name[0] >= 'x' && property.name[0] <= 'z';
      if (is_axis) {
        v[property.name[0] - 'x'] = values->Next(property.type);
      } else {
        Skip(property, values);
      }
    }
    soup->vertices.push_back(v);
  }
}

bool IsCornerList(const Property& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

// Anything that is no index becomes `otherwise`, which the check of all indices refuses.
std::int64_t IndexOf(double value, std::int64_t otherwise) {
  const bool is_index = value >= 0.0 && value < 4294967296.0 && value == std::floor(value);
  return is_index ? static_cast<std::int64_t>(value) : otherwise;
}

void ReadFaces(const Element& element, Values* values, PolygonSoup* soup) {
  for (std::int64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (IsCornerList(property)) {
        ReadList(property, values,
                 [&](double index) { soup->corners.push_back(IndexOf(index, -1)); });
      } else {
        Skip(property, values);
      }
    }
    soup->EndPolygon();
  }
}

void ReadStrips(const Element& element, Values* values, PolygonSoup* soup) {
  for (std::int64_t i = 0; i < element.count; ++i) {
    for (const Property& property : element.properties) {
      if (IsCornerList(property)) {
        std::vector<std::int64_t> corners;
        ReadList(property, values, [&](double index) {
          corners.push_back(index == kStripRestart ? kStripRestart
                                                   : IndexOf(index, kStripRestart - 1));
        });
        AppendStrips(corners, soup);
      } else {
        Skip(property, values);
      }
    }
  }
}

void RequireLayout(const Header& header, const std::string& path) {
  const auto has = [&](const char* element, const auto& is_wanted) {
    return std::any_of(header.elements.begin(), header.elements.end(), [&](const Element& e) {
      return e.name == element && std::any_of(e.properties.begin(), e.properties.end(), is_wanted);
    });
  };
  bool complete = has("face", IsCornerList) || has(kStrips, IsCornerList);
  for (const char* axis : {"x", "y", "z"}) {
    complete = complete && has("vertex", [&](const Property& p) { return p.name == axis; });
  }
  if (!complete) {
    throw InputError("PLY header without a mesh", path,
                     "element vertex with x, y, z and element face (or tristrips) with list "
                     "vertex_indices");
  }
}

}  // namespace

PolygonSoup ReadPly(std::string_view bytes, const std::string& path) {
  TextScanner text(bytes, path);
  const Header header = ReadHeader(&text);
  RequireLayout(header, path);
  std::unique_ptr<Values> values;
  if (header.encoding == Encoding::kAscii) {
    values = std::make_unique<AsciiValues>(text);
  } else {
    values = std::make_unique<BinaryValues>(text.rest(), header.encoding == Encoding::kBig, path);
  }
  PolygonSoup soup;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // no bytes, however many there are
    if (element.name == "vertex") {
      ReadVertices(element, values.get(), &soup);
    } else if (element.name == "face") {
      ReadFaces(element, values.get(), &soup);
    } else if (element.name == kStrips) {
      ReadStrips(element, values.get(), &soup);
    } else {
      for (std::int64_t i = 0; i < element.count; ++i) {
        for (const Property& property : element.properties) Skip(property, values.get());
      }
    }
  }
  return soup;
}

}  // namespace antigrasp
