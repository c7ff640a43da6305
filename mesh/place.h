#pragma once

#include <Eigen/Core>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Where an object lies, to be taken off before work that rounds: 800 m from the world's origin
// single precision knows places to 0.06 mm. Per axis the multiple nearest to the middle of the box
// of the number 1, 2 or 5 times a power of ten that is at least twice the largest extent. So
//   - an object with the origin in its box, or within half its size of it, stays as it is: 0;
//   - any other comes to lie within three extents of the origin: rounding to single precision then
//     takes less than 2e-7 of its size;
//   - copies that people move by round numbers (10 m in an assembly, 400 km on a map) come to lie
//     in one place exactly. About their centres they would not: those are no round numbers.
// Mesh's unit. Zero for a mesh without a finite, positive size. O(vertices).
Eigen::Vector3d RoundPlace(const TriangleMesh& mesh);
Eigen::Vector3d RoundPlace(const BoundingBox& box);

// By how much at most a coordinate of the mesh changes when it is stored in single precision, as
// STL files do: half a unit in the last place of the largest one. Mesh's unit.
double SinglePrecisionLoss(const TriangleMesh& mesh);

// By how much at most the coordinates may have been rounded before. When every one of them is a
// single-precision number, as in a mesh from an STL file: half a unit in the last place of the
// largest that takes more than 21 of the 24 bits; shorter ones, such as 40 or 400000.5, are taken
// for exact. Else 0.
double RoundedBy(const TriangleMesh& mesh);

}  // namespace antigrasp
