#include "antigrasp/report/page/display_mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kLargest = 1e15;  // coordinates: their squares and products stay in a float
constexpr double kSmallest = 1e-15;
constexpr double kSteps = 65535.0;

bool IsDrawable(const TriangleMesh& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Vector3d& v) {
                       return v.allFinite() && v.cwiseAbs().maxCoeff() < kLargest;
                     }) &&
         std::all_of(mesh.faces.begin(), mesh.faces.end(), [count](const auto& face) {
           return std::all_of(face.begin(), face.end(),
                              [count](std::int32_t v) { return v >= 0 && v < count; });
         });
}

std::vector<unsigned int> Indices(const TriangleMesh& mesh) {
  std::vector<unsigned int> indices;
  indices.reserve(3 * mesh.faces.size());
  for (const auto& face : mesh.faces) {
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    for (const std::int32_t v : face) indices.push_back(static_cast<unsigned int>(v));
  }
  return indices;
}

BoundingBox BoundsOfUsed(const TriangleMesh& mesh, const std::vector<unsigned int>& indices) {
  BoundingBox box{mesh.vertices[indices.front()], mesh.vertices[indices.front()]};
  for (const unsigned int v : indices) {
    box.min = box.min.cwiseMin(mesh.vertices[v]);
    box.max = box.max.cwiseMax(mesh.vertices[v]);
  }
  return box;
}

// Quadric simplification keeps the topology, which stops it early on a mesh of many pieces: then
// vertices are clustered instead.
void Simplify(const TriangleMesh& mesh, const DisplayMesh& display, std::size_t max_triangles,
              std::vector<unsigned int>* indices) {
  constexpr float kTolerance = 0.1F;  // of the mesh's extent
  constexpr std::size_t kStride = 3 * sizeof(float);
  std::vector<float> positions;
  positions.reserve(3 * mesh.vertices.size());
  for (const Vector3d& v : mesh.vertices) {
    const Vector3d unit = (v - display.min) / display.extent;
    for (int k = 0; k < 3; ++k) positions.push_back(static_cast<float>(unit[k]));
  }
  const std::size_t target = 3 * max_triangles;
  std::vector<unsigned int> fewer(indices->size());
  fewer.resize(meshopt_simplify(fewer.data(), indices->data(), indices->size(), positions.data(),
                                mesh.vertices.size(), kStride, target, kTolerance, 0, nullptr));
  if (fewer.size() > 2 * target) {
    std::vector<unsigned int> clustered(indices->size());
    clustered.resize(meshopt_simplifySloppy(clustered.data(), indices->data(), indices->size(),
                                            positions.data(), mesh.vertices.size(), kStride, target,
                                            1.0F, nullptr));
    if (!clustered.empty()) fewer = std::move(clustered);
  }
  if (!fewer.empty()) *indices = std::move(fewer);
}

}  // namespace

std::optional<DisplayMesh> MakeDisplayMesh(const TriangleMesh& mesh, std::size_t max_triangles) {
  if (!IsDrawable(mesh)) return std::nullopt;
  std::vector<unsigned int> indices = Indices(mesh);
  if (indices.empty()) return std::nullopt;
  DisplayMesh display;
  const BoundingBox box = BoundsOfUsed(mesh, indices);
  display.min = box.min;
  display.extent = box.Extent().maxCoeff();
  display.full_triangles = indices.size() / 3;
  if (!(display.extent > kSmallest)) return std::nullopt;
  if (display.full_triangles > max_triangles) Simplify(mesh, display, max_triangles, &indices);

  const std::size_t count = mesh.vertices.size();
  display.indices.resize(indices.size());
  meshopt_optimizeVertexCache(display.indices.data(), indices.data(), indices.size(), count);
  std::vector<unsigned int> place(count);  // ~0 for a vertex that no face uses
  const std::size_t used = meshopt_optimizeVertexFetchRemap(place.data(), display.indices.data(),
                                                            display.indices.size(), count);
  display.vertices.resize(used);
  for (std::size_t v = 0; v < count; ++v) {
    if (place[v] < used) display.vertices[place[v]] = mesh.vertices[v];
  }
  for (unsigned int& index : display.indices) index = place[index];
  return display;
}

std::string EncodePositions(const DisplayMesh& mesh) {
  using Quantised = std::array<std::uint16_t, 4>;
  std::vector<Quantised> vertices;
  vertices.reserve(mesh.vertices.size());
  for (const Vector3d& v : mesh.vertices) {
    Quantised q{};
    for (int k = 0; k < 3; ++k) {
      const double share = std::clamp((v[k] - mesh.min[k]) / mesh.extent, 0.0, 1.0);
      q[static_cast<std::size_t>(k)] = static_cast<std::uint16_t>(std::lround(share * kSteps));
    }
    vertices.push_back(q);
  }
  std::string bytes(meshopt_encodeVertexBufferBound(vertices.size(), sizeof(Quantised)), '\0');
  bytes.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                          bytes.size(), vertices.data(), vertices.size(),
                                          sizeof(Quantised)));
  return bytes;
}

std::string EncodeIndices(const DisplayMesh& mesh) {
  std::string bytes(meshopt_encodeIndexBufferBound(mesh.indices.size(), mesh.vertices.size()),
                    '\0');
  bytes.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(bytes.data()),
                                         bytes.size(), mesh.indices.data(), mesh.indices.size()));
  return bytes;
}

}  // namespace antigrasp
