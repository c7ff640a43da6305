#pragma once

#include <Eigen/Core>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// The sides of the smallest of the boxes that lie flush with one of the thousand largest facets of
// the convex hull, rising (trimesh's oriented bounds, which EGAD takes, try all). Mesh's unit; zero
// for a flat mesh. O(n log n) in the corners n of the hull, for each of these facets.
Eigen::Vector3d OrientedExtents(const TriangleMesh& mesh);

// Metres per unit by EGAD's rule, for a gripper that opens `opening` metres (prepare_meshes.py of
// dougsm/egad 264ac92): longest side = opening, then the shortest at most 0.8 of it.
double EgadScale(const Eigen::Vector3d& oriented_extents, double opening);

}  // namespace antigrasp
