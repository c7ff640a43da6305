#include "tests/mesh/unit_files.h"

#include <zip.h>

#include <array>
#include <cstdint>

#include "antigrasp/core/atomic_file.h"
#include "tests/support/temp_folder.h"

namespace antigrasp::shapes {
namespace {

// Corners by their bits x, y, z.
constexpr std::array<std::array<int, 3>, 12> kCube = {{{0, 2, 1},
                                                       {1, 2, 3},
                                                       {4, 5, 6},
                                                       {5, 7, 6},
                                                       {0, 1, 4},
                                                       {1, 5, 4},
                                                       {2, 6, 3},
                                                       {3, 6, 7},
                                                       {0, 4, 2},
                                                       {2, 4, 6},
                                                       {1, 3, 5},
                                                       {3, 7, 5}}};

std::string Little(std::uint32_t value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string CubeXml(const std::string& more_triangles) {
  std::string xml = "<object id=\"1\" type=\"model\"><mesh><vertices>";
  for (int i = 0; i < 8; ++i) {
    const auto at = [&](int bit) { return i >> bit & 1 ? "20" : "0"; };
    xml += std::string("<vertex x=\"") + at(0) + "\" y=\"" + at(1) + "\" z=\"" + at(2) + "\"/>";
  }
  xml += "</vertices><triangles>";
  for (const auto& t : kCube) {
    xml += "<triangle v1=\"" + std::to_string(t[0]) + "\" v2=\"" + std::to_string(t[1]) +
           "\" v3=\"" + std::to_string(t[2]) + "\"/>";
  }
  return xml + more_triangles + "</triangles></mesh></object>";
}

std::string ModelXml(const std::string& unit, const std::string& resources,
                     const std::string& build) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model" +
         (unit.empty() ? "" : " unit=\"" + unit + "\"") + " xmlns=\"" + k3mfCore +
         "\" xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\">\n"
         "<resources>" +
         resources + "</resources>\n<build>" + build + "</build></model>\n";
}

std::string ZipBytes(const std::map<std::string, std::string>& files) {
  const TempFolder folder;
  const auto path = folder / "a.zip";
  zip_t* const zip = zip_open(path.c_str(), ZIP_CREATE, nullptr);
  for (const auto& [name, bytes] : files) {
    zip_file_add(zip, name.c_str(), zip_source_buffer(zip, bytes.data(), bytes.size(), 0), 0);
  }
  zip_close(zip);
  return ReadFile(path);
}

std::string ThreeMfBytes(const std::string& model, const std::map<std::string, std::string>& more) {
  std::map<std::string, std::string> files = more;
  files["_rels/.rels"] =
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/cube.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  files["3D/cube.model"] = model;
  return ZipBytes(files);
}

std::string GlbBytes(std::string json, std::string bin) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  const std::string chunks = Little(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
                             Little(static_cast<std::uint32_t>(bin.size())) +
                             std::string("BIN\0", 4) + bin;
  return "glTF" + Little(2) + Little(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

std::string CubeBin() {
  std::string bin;
  for (int i = 0; i < 8; ++i) {
    for (int bit = 0; bit < 3; ++bit) {
      const float at = i >> bit & 1 ? 0.02f : 0.0f;
      bin.append(reinterpret_cast<const char*>(&at), sizeof at);
    }
  }
  for (const auto& t : kCube) {
    for (const int corner : t) bin += {static_cast<char>(corner), '\0'};
  }
  return bin;
}

std::string CubeJson(const std::string& node) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" +
         node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":8,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}],"bufferViews":)"
         R"([{"buffer":0,"byteOffset":0,"byteLength":96},{"buffer":0,"byteOffset":96,)"
         R"("byteLength":72}],"buffers":[{"byteLength":168}]})";
}

std::string CubeGlb(const std::string& node) { return GlbBytes(CubeJson(node), CubeBin()); }

}  // namespace antigrasp::shapes
