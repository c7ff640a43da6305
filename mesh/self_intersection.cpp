#include "antigrasp/mesh/self_intersection.h"

#include <algorithm>
#include <vector>

#include "antigrasp/mesh/face_blocks.h"
#include "antigrasp/mesh/face_intersection.h"
#include "antigrasp/mesh/vertex_stars.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// Vertices between -2 and 2, each coordinate rounded by steps that keep the order: boxes that meet
// still do.
std::vector<Vector3f> SmallVertices(const TriangleMesh& mesh) {
  double unit = 0.0;
  for (const Vector3d& v : mesh.vertices) unit = std::max(unit, v.cwiseAbs().maxCoeff());
  if (!(unit > 0.0)) unit = 1.0;
  std::vector<Vector3f> small;
  small.reserve(mesh.vertices.size());
  const Vector3d first = mesh.vertices.empty() ? Vector3d::Zero() : mesh.vertices[0];
  for (const Vector3d& v : mesh.vertices) small.push_back((v / unit - first / unit).cast<float>());
  return small;
}

// Calls visit(face, face) for all pairs that may meet in more than what they share, until it
// returns true; whether it did.
template <typename Visit>
bool AnyDoubtfulPair(const TriangleMesh& mesh, const Visit& visit) {
  const FaceBlocks blocks(SmallVertices(mesh), mesh.faces, Vector3d::Zero());
  const std::vector<char> plain = PlainStars(mesh);
  return blocks.AnyTouching([&](std::uint32_t first, std::uint32_t second) {
    const auto& other = mesh.faces[second];
    for (const std::int32_t v : mesh.faces[first]) {
      if (plain[static_cast<std::size_t>(v)] == 0) continue;
      if (v == other[0] || v == other[1] || v == other[2]) return false;
    }
    return visit(first, second);
  });
}

bool Meet(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second) {
  return FacesIntersect(mesh, static_cast<std::int32_t>(first), static_cast<std::int32_t>(second));
}

}  // namespace

bool SelfIntersects(const TriangleMesh& mesh) {
  return AnyDoubtfulPair(
      mesh, [&](std::uint32_t first, std::uint32_t second) { return Meet(mesh, first, second); });
}

std::set<std::pair<std::int32_t, std::int32_t>> MeetingPieces(const TriangleMesh& mesh,
                                                              const Pieces& pieces) {
  std::set<std::pair<std::int32_t, std::int32_t>> meeting;
  AnyDoubtfulPair(mesh, [&](std::uint32_t first, std::uint32_t second) {
    const auto pair = std::minmax(pieces.of_face[first], pieces.of_face[second]);
    if (!meeting.contains(pair) && Meet(mesh, first, second)) meeting.insert(pair);
    return false;
  });
  return meeting;
}

}  // namespace antigrasp
