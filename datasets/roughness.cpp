#include "antigrasp/datasets/roughness.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "antigrasp/mesh/topology.h"

namespace antigrasp {

using Eigen::Vector3d;

double MeanDihedralAngle(const TriangleMesh& mesh) {
  double weighted = 0.0, length = 0.0;
  const std::vector<EdgeUse> uses = SortedEdgeUses(mesh);
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first != 2) return;
    const EdgeUse& a = *first;
    const EdgeUse& b = *(first + 1);
    const Vector3d u = FaceCross(mesh, static_cast<std::size_t>(a.face));
    // Faces wound against each other have one normal inside: turn it out.
    const Vector3d v =
        (a.forward == b.forward ? -1.0 : 1.0) * FaceCross(mesh, static_cast<std::size_t>(b.face));
    if (u.isZero(0.0) || v.isZero(0.0)) return;
    const double edge = (mesh.vertices[static_cast<std::size_t>(a.high)] -
                         mesh.vertices[static_cast<std::size_t>(a.low)])
                            .norm();
    // atan2 keeps small angles, which acos of a dot product loses.
    weighted += edge * std::atan2(u.cross(v).norm(), u.dot(v));
    length += edge;
  });
  return length > 0.0 ? 180.0 / std::numbers::pi * weighted / length : 0.0;
}

}  // namespace antigrasp
