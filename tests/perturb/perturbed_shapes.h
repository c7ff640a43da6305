#pragma once

#include <Eigen/Core>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp::shapes {

// The regular tetrahedron with circumradius 1: neighbours meet at 70.53 degrees.
TriangleMesh RegularTetrahedron();

// The regular dodecahedron with circumradius 1, each pentagon cut into three triangles from one
// corner: 36 faces.
TriangleMesh Dodecahedron();

// Unconnected triangles given by their corners.
TriangleMesh Triangles(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles);

// Every vertex moved by up to `size` along each axis.
TriangleMesh Shaken(TriangleMesh mesh, double size, RngStream* rng);

// A rotation drawn from the stream.
Eigen::Matrix3d RandomRotation(RngStream* rng);

}  // namespace antigrasp::shapes
