#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Shares of the object's size: how far a facet may be from flat, and how far inside a facet the
// centre of mass must stand for the pose to be stable.
constexpr double kFlat = 1e-5;
constexpr double kBalance = 1e-6;

struct Segment {
  Eigen::Vector3d a, b;
  std::int32_t from = -1, to = -1;  // the numbers of a and b among the hull's vertices
};

// A flat facet of the hull; everything relative to the centre of mass.
struct Facet {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // outward unit
  double height = 0.0;                               // of the centre of mass above it
  double solid_angle = 0.0;                          // seen from the centre of mass
  std::vector<Segment> border;                       // counter-clockwise seen from outside
};

// What an object stands and rolls on, in the mesh's unit.
struct FacetedHull {
  TriangleMesh mesh;  // centre of mass at the origin
  double size = 0.0;  // diagonal of the bounding box
  std::vector<Facet> facets;
};

// The convex hull with neighbouring triangles within kFlat of one plane as one facet. No facet when
// the vertices lie in one plane. O(n log n): 0.4 s for 100,000 faces.
FacetedHull MakeFacetedHull(const TriangleMesh& mesh, const Eigen::Vector3d& com);

}  // namespace antigrasp
