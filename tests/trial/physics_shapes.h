#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/convex_hull.h"
#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {

// A cube of this edge with the middles of the faces at +x, +y and +z moved out (paper VII-A): their
// parts oppose the flat faces under this angle.
inline TriangleMesh BevelledCube(double degrees, double edge) {
  std::vector<Eigen::Vector3d> corners = shapes::Cube().vertices;
  const double out = 0.5 + 0.5 * std::tan(degrees * kDegree);
  for (int k = 0; k < 3; ++k) corners.push_back(out * Eigen::Vector3d::Unit(k));
  return Transformed(ConvexHull(corners), edge, Eigen::Vector3d::Zero());
}

// The hull of points on an ellipsoid about the origin.
inline TriangleMesh RandomHull(std::uint64_t stream, int points, const Eigen::Vector3d& half) {
  RngStream rng(7, "hull", stream);
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < points; ++i) corners.push_back(half.cwiseProduct(DrawDirection(&rng)));
  return ConvexHull(corners);
}

}  // namespace antigrasp
