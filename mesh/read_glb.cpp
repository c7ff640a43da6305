#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/placed_soup.h"
#include "antigrasp/mesh/text_scanner.h"
#include "antigrasp/mesh/triangle_strip.h"

// glTF 2.0 in one binary file. Of its JSON only what places triangles is looked at.
namespace antigrasp {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::size_t kMostJson = std::size_t{16} << 20;  // a value of one letter takes 16 bytes
constexpr int kDeepestJson = 64;
constexpr std::uint64_t kMostOffset = std::uint64_t{1} << 40, kMostStride = 252;

enum GlbMode { kTriangles = 4, kStrip = 5, kFan = 6 };
enum GlbComponent { kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126 };

template <typename T>
T LoadAt(std::string_view bytes, std::uint64_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// Extensions that do not change where triangles are.
bool IsHarmless(std::string_view extension) {
  for (const char* kind : {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_"}) {
    if (extension.starts_with(kind)) return true;
  }
  return false;
}

class Glb {
 public:
  Glb(std::string_view bytes, const std::string& path) : path_(path) {
    if (bytes.size() < kHeader || !bytes.starts_with("glTF")) {
      Fail("not GLB: it does not begin with 'glTF'", "glTF 2.0 in one binary file");
    }
    const auto version = LoadAt<std::uint32_t>(bytes, 4), length = LoadAt<std::uint32_t>(bytes, 8);
    if (version != 2) Fail("glTF " + std::to_string(version), "glTF 2.0");
    if (length > bytes.size()) {
      Fail("truncated: " + std::to_string(bytes.size()) + " bytes of " + std::to_string(length),
           "a whole file");
    }
    bytes = bytes.substr(kHeader, std::max<std::size_t>(length, kHeader) - kHeader);
    ParseJson(TakeChunk("JSON", &bytes));
    if (!bytes.empty()) bin_ = TakeChunk(std::string_view("BIN\0", 4), &bytes);
    for (const Json& name : List(json_, "extensionsRequired")) {
      if (name.is_string() && IsHarmless(name.get_ref<const std::string&>())) continue;
      Fail("needs the extension " + name.dump(-1, ' ', true, Json::error_handler_t::replace),
           "glTF 2.0 without extensions, not compressed");
    }
  }

  PolygonSoup Soup() {
    const Json& scene = At("scenes", Whole(json_, "scene", 0), "scene");
    std::vector<std::pair<std::uint64_t, Eigen::Affine3d>> open;  // nodes, and what they stand in
    const auto open_all = [&](const Json& nodes, const Eigen::Affine3d& outer) {
      for (std::size_t i = nodes.size(); i-- > 0;) {  // the first comes off first
        open.emplace_back(AsWhole(nodes[i], "node"), outer);
      }
    };
    open_all(List(scene, "nodes"), Eigen::Affine3d::Identity());
    std::vector<bool> seen(List(json_, "nodes").size(), false);
    while (!open.empty()) {
      const auto [number, outer] = open.back();
      open.pop_back();
      const Json& node = At("nodes", number, "node");
      const std::string name = "node " + std::to_string(number);
      if (seen[number]) Fail(name + " stands in two places", "nodes that are a tree");
      seen[number] = true;
      const Eigen::Affine3d place = outer * PlaceOf(node, name);
      if (node.contains("mesh")) AddMesh(Whole(node, "mesh"), place);
      open_all(List(node, "children"), place);
    }
    if (!List(json_, "skins").empty()) soup_.notes.push_back("skins are not applied");
    if (left_out_ > 0) {
      soup_.notes.push_back(std::to_string(left_out_) + " primitives of points or lines left out");
    }
    soup_.unit = FileUnit{"m", 1.0};
    return std::move(soup_);
  }

 private:
  std::string_view TakeChunk(std::string_view type, std::string_view* bytes) const {
    const std::string expected = "a chunk of " + std::string(type.substr(0, 4));
    if (bytes->size() < kChunkHeader) Fail("file ends early", expected);
    const auto length = LoadAt<std::uint32_t>(*bytes, 0);
    if (bytes->substr(4, 4) != type || length > bytes->size() - kChunkHeader) {
      Fail("damaged chunk " + Quoted(bytes->substr(4, 4)) + " of " + std::to_string(length) +
               " bytes",
           expected);
    }
    const std::string_view chunk = bytes->substr(kChunkHeader, length);
    bytes->remove_prefix(kChunkHeader + length);
    return chunk;
  }

  void ParseJson(std::string_view text) {
    if (text.size() > kMostJson) Fail("JSON larger than 16 MiB", "meshes in the binary chunk");
    json_ = Json::parse(
        text,
        [&](int depth, Json::parse_event_t, const Json&) {
          if (depth > kDeepestJson) Fail("JSON nested too deep", "glTF 2.0");
          return true;
        },
        false);
    if (!json_.is_object()) Fail("damaged JSON", "glTF 2.0");
  }

  void AddMesh(std::uint64_t number, const Eigen::Affine3d& place) {
    const std::string name = "mesh " + std::to_string(number);
    for (const Json& primitive : List(At("meshes", number, "mesh"), "primitives")) {
      const std::uint64_t mode = Whole(primitive, "mode", kTriangles);
      if (mode < kTriangles) {
        ++left_out_;
        continue;
      }
      if (mode > kFan) Fail(name + ": mode " + std::to_string(mode), "triangles, strips or fans");
      RequirePlain(primitive, name);
      PolygonSoup part;
      part.vertices =
          Positions(At("accessors", Whole(Child(primitive, "attributes"), "POSITION"), "accessor"));
      AddFaces(Corners(primitive, part.vertices.size()), mode, name, &part);
      AppendPlaced(part, place, name, path_, &soup_);
    }
  }

  void AddFaces(const std::vector<std::int64_t>& corners, std::uint64_t mode,
                const std::string& name, PolygonSoup* part) const {
    if (mode == kStrip) return AppendStrips(corners, part);
    if (mode == kTriangles && corners.size() % 3 != 0) {
      Fail(name + ": " + std::to_string(corners.size()) + " corners of triangles",
           "three a triangle");
    }
    for (std::size_t i = 2; i < corners.size(); i += mode == kFan ? 1 : 3) {
      part->corners.insert(part->corners.end(), {mode == kFan ? corners[0] : corners[i - 2],
                                                 corners[i - 1], corners[i]});
      part->EndPolygon();
    }
  }

  std::vector<Eigen::Vector3d> Positions(const Json& accessor) const {
    if (Child(accessor, "type") != "VEC3" || Whole(accessor, "componentType") != kFloat) {
      Fail("positions of another type", "three numbers of float32 a vertex");
    }
    const Elements elements = ElementsOf(accessor, 3 * sizeof(float));
    std::vector<Eigen::Vector3d> positions;
    for (std::uint64_t i = 0; i < elements.count; ++i) {
      const std::uint64_t at = i * elements.stride;
      positions.emplace_back(LoadAt<float>(elements.bytes, at),
                             LoadAt<float>(elements.bytes, at + 4),
                             LoadAt<float>(elements.bytes, at + 8));
    }
    return positions;
  }

  // Without indices the vertices come as they lie.
  std::vector<std::int64_t> Corners(const Json& primitive, std::size_t vertices) const {
    std::vector<std::int64_t> corners;
    if (!primitive.contains("indices")) {
      for (std::size_t i = 0; i < vertices; ++i) corners.push_back(static_cast<std::int64_t>(i));
      return corners;
    }
    const Json& accessor = At("accessors", Whole(primitive, "indices"), "accessor");
    const std::uint64_t type = Whole(accessor, "componentType");
    const std::uint64_t size = type == kByte ? 1 : type == kShort ? 2 : type == kInt ? 4 : 0;
    if (size == 0 || Child(accessor, "type") != "SCALAR") {
      Fail("indices of another type", "whole numbers of 8, 16 or 32 bits without a sign");
    }
    const Elements elements = ElementsOf(accessor, size);
    for (std::uint64_t i = 0; i < elements.count; ++i) {
      const std::uint64_t at = i * elements.stride;
      corners.push_back(size == 1   ? LoadAt<std::uint8_t>(elements.bytes, at)
                        : size == 2 ? LoadAt<std::uint16_t>(elements.bytes, at)
                                    : LoadAt<std::uint32_t>(elements.bytes, at));
    }
    return corners;
  }

  struct Elements {
    std::string_view bytes;
    std::uint64_t count, stride;
  };
  // Of an accessor, every one of them within its view and the view within the binary chunk.
  Elements ElementsOf(const Json& accessor, std::uint64_t size) const {
    RequirePlain(accessor, "accessor");
    if (accessor.contains("sparse")) Fail("a sparse accessor", "plain accessors");
    const Json& view = At("bufferViews", Whole(accessor, "bufferView"), "bufferView");
    RequirePlain(view, "bufferView");
    if (Whole(view, "buffer") != 0 || At("buffers", 0, "buffer").contains("uri")) {
      Fail("a buffer in another file", "everything in the one binary chunk");
    }
    const std::uint64_t begin = Whole(view, "byteOffset", 0), length = Whole(view, "byteLength");
    const std::uint64_t stride = Whole(view, "byteStride", size);
    const std::uint64_t offset = Whole(accessor, "byteOffset", 0);
    const std::uint64_t count = Whole(accessor, "count");
    if (stride < size || stride > kMostStride) {
      Fail("byteStride " + std::to_string(stride), std::to_string(size) + " to 252");
    }
    const std::uint64_t end = count == 0 ? offset : offset + (count - 1) * stride + size;
    if (begin + length > bin_.size() || end > length) {
      Fail("an accessor of " + std::to_string(count) + " elements reaches beyond its bytes",
           "elements within the binary chunk of " + std::to_string(bin_.size()) + " bytes");
    }
    return {bin_.substr(begin + offset), count, stride};
  }

  // A matrix by columns; or scale, then rotation (x y z w), then translation.
  Eigen::Affine3d PlaceOf(const Json& node, const std::string& name) const {
    Eigen::Affine3d place = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
      const std::vector<double> m = Numbers(node, "matrix", 16, name);
      for (int i = 0; i < 12; ++i)
        place(i % 3, i / 3) = m[static_cast<std::size_t>(i / 3 * 4 + i % 3)];
      return place;
    }
    if (node.contains("translation")) {
      const auto t = Numbers(node, "translation", 3, name);
      place.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    }
    if (node.contains("rotation")) {
      const auto q = Numbers(node, "rotation", 4, name);
      place.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
    }
    if (node.contains("scale")) {
      const auto s = Numbers(node, "scale", 3, name);
      place.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    }
    return place;
  }

  std::vector<double> Numbers(const Json& object, const char* key, std::size_t count,
                              const std::string& name) const {
    const Json& list = List(object, key);
    std::vector<double> numbers;
    for (const Json& number : list) {
      if (number.is_number()) numbers.push_back(number.get<double>());
    }
    if (numbers.size() == count && list.size() == count) return numbers;
    Fail(name + ": " + key, std::to_string(count) + " numbers");
  }

  // Nothing that a compressing extension replaces.
  void RequirePlain(const Json& object, const std::string& name) const {
    if (!object.contains("extensions")) return;
    for (const char* key : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
      if (Child(object, "extensions").contains(key)) Fail(name + " by " + key, "not compressed");
    }
  }

  // Null where there is none.
  const Json& Child(const Json& object, const char* key) const {
    static const Json none;
    if (!object.is_object()) Fail(std::string("no ") + key, "glTF 2.0");
    const auto found = object.find(key);
    return found == object.end() ? none : *found;
  }
  const Json& List(const Json& object, const char* key) const {
    static const Json none = Json::array();
    const Json& list = Child(object, key);
    if (list.is_null()) return none;
    if (!list.is_array()) Fail(std::string(key) + " is no list", "glTF 2.0");
    return list;
  }
  const Json& At(const char* list, std::uint64_t number, const char* noun) const {
    const Json& all = List(json_, list);
    if (number < all.size()) return all[number];
    Fail("no " + std::string(noun) + " " + std::to_string(number),
         std::to_string(all.size()) + " in " + list);
  }
  std::uint64_t AsWhole(const Json& value, const std::string& key) const {
    const bool whole = value.is_number_unsigned() && value.get<std::uint64_t>() <= kMostOffset;
    if (!whole) Fail(key + " is no number from 0", "glTF 2.0");
    return value.get<std::uint64_t>();
  }
  std::uint64_t Whole(const Json& object, const char* key) const {
    return AsWhole(Child(object, key), key);
  }
  std::uint64_t Whole(const Json& object, const char* key, std::uint64_t otherwise) const {
    return Child(object, key).is_null() ? otherwise : Whole(object, key);
  }
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, path_, expected);
  }

  const std::string& path_;
  Json json_;
  std::string_view bin_;
  PolygonSoup soup_;
  int left_out_ = 0;
};

}  // namespace

PolygonSoup ReadGlb(std::string_view bytes, const std::string& path) {
  return Glb(bytes, path).Soup();
}

}  // namespace antigrasp
