#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What planes leave of a solid: the solid within all `sides`. The faces that the cuts make are not
// kept: the hull needs the cut surface and the places inside where three sides meet.
struct SolidPiece {
  TriangleMesh surface;  // the solid's own, cut; open
  std::vector<HalfSpace> sides;
  std::vector<Eigen::Vector3d> corners;  // of the sides, inside the solid
};

using InsideTest = std::function<bool(const Eigen::Vector3d&)>;  // of the solid

// All points of the piece that its hull may have as corners.
std::vector<Eigen::Vector3d> HullPoints(const SolidPiece& piece);

// The same of both sides of a plane, without cutting: behind it (normal . p <= offset) and before.
std::array<std::vector<Eigen::Vector3d>, 2> HullPointsOfSides(const SolidPiece& piece,
                                                              const HalfSpace& plane,
                                                              const InsideTest& inside);

// Both sides: behind the plane and before it. A vertex in the plane counts as behind.
std::array<SolidPiece, 2> Cut(const SolidPiece& piece, const HalfSpace& plane,
                              const InsideTest& inside);

}  // namespace antigrasp
