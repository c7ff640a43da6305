#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace antigrasp {

// Triangles with shared vertices. Faces are counter-clockwise seen from outside. The mesh may be
// open or broken: ask Inspect(). No unit of its own; functions that need metres say so.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> faces;
};

struct BoundingBox {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();
  Eigen::Vector3d max = Eigen::Vector3d::Zero();
  Eigen::Vector3d Extent() const { return max - min; }
  Eigen::Vector3d Center() const { return 0.5 * (min + max); }
};

BoundingBox Bounds(const TriangleMesh& mesh);  // zero box for no vertices

// (b - a) x (c - a): twice the area times the outward unit normal.
Eigen::Vector3d FaceCross(const TriangleMesh& mesh, std::size_t face);

double SurfaceArea(const TriangleMesh& mesh);

// Signed volume by the divergence theorem: positive when a closed mesh is outward oriented.
double Volume(const TriangleMesh& mesh);

// Centre of mass of the solid; of the surface when the volume is ~0 or that is outside the box.
Eigen::Vector3d CenterOfMass(const TriangleMesh& mesh);

// v -> scale * v + translation for every vertex.
TriangleMesh Transformed(const TriangleMesh& mesh, double scale,
                         const Eigen::Vector3d& translation);

}  // namespace antigrasp
