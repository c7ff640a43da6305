#pragma once

#include <Eigen/Core>

#include "antigrasp/mesh/triangle_mesh.h"
#include "tests/support/temp_folder.h"

// Meshes whose volume, area and topology are known on paper. Unless said otherwise they are closed,
// oriented outward and centred at the origin.
namespace antigrasp::shapes {

// Icosphere: 20 * 4^subdivisions faces, vertices exactly at `radius`.
TriangleMesh Sphere(double radius, int subdivisions);

// 12 faces, 8 vertices, edge lengths `extents`.
TriangleMesh Box(const Eigen::Vector3d& extents);
TriangleMesh Cube();  // edge 1

// Corners 0, e_x, e_y, e_z: volume 1/6. Not centred.
TriangleMesh Tetrahedron();

// Around z: n segments along the ring of radius `ring`, m around the tube of radius `tube`.
// Genus 1.
TriangleMesh Torus(double ring, double tube, int n, int m);

// A prism over the regular n-gon inscribed in the circle of `radius`, axis along z, with a vertex
// in the middle of each cap.
TriangleMesh Cylinder(double radius, double height, int n);

// [-1/2, 1/2]^2 at z = 0, facing +z; open: 4 boundary edges, area 1.
TriangleMesh FlatSquare();

// Every vertex multiplied by the rotation (any matrix without reflection keeps the mesh outward).
TriangleMesh Rotated(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation);

// The same surface with the winding of every face turned.
TriangleMesh Inverted(const TriangleMesh& mesh);

// Both meshes in one, nothing merged.
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace antigrasp::shapes
