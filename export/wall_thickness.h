#pragma once

#include <Eigen/Core>
#include <optional>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

struct WallOptions {
  double opposite_angle = 45.0;  // how far two sides of a wall may be from parallel, degrees
  int samples = 2000;            // over the surface, beside the middle of every face
  double thin = 0.0;             // thin_share counts what is thinner, in the mesh's unit
  double rounding = 0.0;         // of coordinates, mesh's unit (rounding.h)
};

struct WallThickness {
  std::optional<double> smallest;                // in the mesh's unit; none when nothing is a wall
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // a surface point of the smallest wall
  double thin_share = 0.0;                       // of the surface that belongs to thin walls
};

// How thick the walls of a solid are, by rays: from a point of the surface straight inward to the
// next face (the "ray method", as in Inui et al., "Shrinking sphere: a parallel algorithm for
// computing the thickness of 3D objects", 2016, which sets it beside the sphere method). What a ray
// meets is the other side of a wall only when it faces away from the point's own side to within
// `opposite_angle`. The distance alone would read zero beside every edge (as the inscribed sphere
// does); so a box reads as its shortest side, a ball as its diameter, a tube as its shell, and a
// regular tetrahedron, whose sides face each other nowhere, has no wall. What tapers at less than
// the angle, a blade or a needle, is read at the samples nearest to its edge: down to about 0. What
// tapers at exactly the angle, as edges of 45 degrees do, is no wall, however it is rounded.
//
// Any mesh that is oriented outward; slivers without area are left out. The same numbers
// everywhere: points come from a stream of their own. 2 ms for 2,500 faces.
WallThickness MeasureWalls(const TriangleMesh& mesh, const WallOptions& options = {});

}  // namespace antigrasp
