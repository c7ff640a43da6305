#include "antigrasp/export/glb.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is little endian");

struct Corner {
  std::size_t face;
  int place;  // in the face
};

// Vertices with a normal each, several where a vertex of the solid has edges.
struct Shaded {
  std::vector<Vector3f> positions, normals;
  std::vector<std::uint32_t> corners;
};

Vector3d UpIsY(const Vector3d& v) { return {v.x(), v.z(), -v.y()}; }

double CornerAngle(const TriangleMesh& mesh, const Corner& corner) {
  const auto& face = mesh.faces[corner.face];
  const Vector3d& at = mesh.vertices[face[corner.place]];
  const Vector3d a = mesh.vertices[face[(corner.place + 1) % 3]] - at;
  const Vector3d b = mesh.vertices[face[(corner.place + 2) % 3]] - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Shaded Shade(const TriangleMesh& mesh, double crease) {
  constexpr double kMillimetre = 1e-3;
  std::vector<Vector3d> of_face;
  std::vector<std::vector<Corner>> around(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    const Vector3d& at = mesh.vertices[face[0]];
    of_face.push_back(
        (mesh.vertices[face[1]] - at).cross(mesh.vertices[face[2]] - at).stableNormalized());
    for (int k = 0; k < 3; ++k) around[face[k]].push_back({f, k});
  }
  Shaded shaded;
  shaded.corners.resize(3 * mesh.faces.size());
  const double least_cosine = std::cos(crease);
  for (std::size_t v = 0; v < around.size(); ++v) {
    std::map<std::array<float, 3>, std::uint32_t> written;  // of this vertex, by their normals
    for (const Corner& corner : around[v]) {
      Vector3d sum = Vector3d::Zero();
      for (const Corner& other : around[v]) {
        if (of_face[other.face].dot(of_face[corner.face]) < least_cosine) continue;
        sum += CornerAngle(mesh, other) * of_face[other.face];
      }
      const Vector3d unit = sum.norm() > 0.0 ? Vector3d(sum.normalized()) : of_face[corner.face];
      const Vector3f normal = UpIsY(unit).cast<float>();
      const auto next = static_cast<std::uint32_t>(shaded.positions.size());
      const auto [place, is_new] = written.try_emplace({normal.x(), normal.y(), normal.z()}, next);
      if (is_new) {
        shaded.positions.push_back(UpIsY(kMillimetre * mesh.vertices[v]).cast<float>());
        shaded.normals.push_back(normal);
      }
      shaded.corners[3 * corner.face + static_cast<std::size_t>(corner.place)] = place->second;
    }
  }
  return shaded;
}

Json Three(const Vector3f& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json Document(const Shaded& shaded, const std::string& name) {
  enum { kFloat = 5126, kWhole = 5125, kVertices = 34962, kCorners = 34963, kTriangles = 4 };
  const std::size_t bytes = sizeof(Vector3f) * shaded.positions.size();
  const std::size_t corner_bytes = sizeof(std::uint32_t) * shaded.corners.size();
  Vector3f least = shaded.positions.front(), most = least;
  for (const Vector3f& v : shaded.positions) {
    least = least.cwiseMin(v);
    most = most.cwiseMax(v);
  }
  const auto view = [](std::size_t at, std::size_t length, int target) {
    return Json{{"buffer", 0}, {"byteOffset", at}, {"byteLength", length}, {"target", target}};
  };
  const auto vectors = [&](int place) {
    return Json{{"bufferView", place},
                {"componentType", int{kFloat}},
                {"count", shaded.positions.size()},
                {"type", "VEC3"}};
  };
  Json positions = vectors(0);
  positions["min"] = Three(least);
  positions["max"] = Three(most);
  const Json corners = {{"bufferView", 2},
                        {"componentType", int{kWhole}},
                        {"count", shaded.corners.size()},
                        {"type", "SCALAR"}};
  const Json primitive = {{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}},
                          {"indices", 2},
                          {"material", 0},
                          {"mode", int{kTriangles}}};
  const Json grey = {{"baseColorFactor", Json::array({0.6, 0.6, 0.6, 1.0})},
                     {"metallicFactor", 0.0},
                     {"roughnessFactor", 0.8}};
  return {{"asset", {{"version", "2.0"}, {"generator", "antigrasp"}}},
          {"scene", 0},
          {"scenes", Json::array({{{"nodes", Json::array({0})}}})},
          {"nodes", Json::array({{{"mesh", 0}, {"name", name}}})},
          {"meshes", Json::array({{{"name", name}, {"primitives", Json::array({primitive})}}})},
          {"materials", Json::array({{{"pbrMetallicRoughness", grey}}})},
          {"accessors", Json::array({positions, vectors(1), corners})},
          {"bufferViews", Json::array({view(0, bytes, kVertices), view(bytes, bytes, kVertices),
                                       view(2 * bytes, corner_bytes, kCorners)})},
          {"buffers", Json::array({{{"byteLength", 2 * bytes + corner_bytes}}})}};
}

template <typename T>
void AppendAll(const std::vector<T>& values, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(values.data()), sizeof(T) * values.size());
}

void AppendWord(std::size_t value, std::string* bytes) {
  const auto word = static_cast<std::uint32_t>(value);
  bytes->append(reinterpret_cast<const char*>(&word), sizeof word);
}

}  // namespace

std::string GlbBytes(const TriangleMesh& mesh, const std::string& name, double crease) {
  const Shaded shaded = Shade(mesh, crease);
  std::string json = Document(shaded, name).dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string binary;
  AppendAll(shaded.positions, &binary);
  AppendAll(shaded.normals, &binary);
  AppendAll(shaded.corners, &binary);
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  std::string bytes = "glTF";
  AppendWord(2, &bytes);
  AppendWord(kHeader + 2 * kChunkHeader + json.size() + binary.size(), &bytes);
  AppendWord(json.size(), &bytes);
  bytes += "JSON" + json;
  AppendWord(binary.size(), &bytes);
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

}  // namespace antigrasp
