#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// The same surface with no edge longer than `length`: faces are cut at the middle of their longest
// edge. Vertices may lie on edges of neighbours.
TriangleMesh Refined(const TriangleMesh& mesh, double length);

// A surface by points on it: where a hull covers it, and which way it faces there.
struct SurfacePoints {
  std::vector<Eigen::Vector3d> points;   // corners, then middles of faces
  std::vector<Eigen::Vector3d> normals;  // outward and unit, of all points
  std::vector<Eigen::Vector3d> middles;  // of faces alone
  std::vector<Eigen::Vector3d> crosses;  // of faces: outward normal times twice the area
};
SurfacePoints PointsOf(const TriangleMesh& mesh);

struct DeepPoint {
  double depth = 0.0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

// Where the surface lies deepest in the hull, measured along its normal: how deep a dent it covers.
// No more than `enough` when
// nothing is deeper.
DeepPoint DeepestIn(const ConvexPart& hull, const SurfacePoints& surface, double enough);

// At most `count` places, far from each other, that are at least `share` times as deep as the
// deepest, which comes first.
std::vector<Eigen::Vector3d> DeepPlaces(const ConvexPart& hull, const SurfacePoints& surface,
                                        const DeepPoint& deepest, double share, std::size_t count);

}  // namespace antigrasp
