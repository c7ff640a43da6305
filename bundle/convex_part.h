#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// normal . p <= offset; `normal` is a unit vector.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
  double offset = 0.0;
  double Outside(const Eigen::Vector3d& p) const { return normal.dot(p) - offset; }
};

// A convex hull with its planes.
struct ConvexPart {
  TriangleMesh mesh;  // closed, outward; no faces when the points lie in one plane
  std::vector<HalfSpace>
      planes;  // one a facet, facets in one plane (1e-6 of the size) counted once
  BoundingBox box;
  double volume = 0.0;

  bool empty() const { return planes.empty(); }
  // How far it is from a point inside to the surface along a direction; 0 outside. Stops, and
  // returns no more than that, where it is within `enough`.
  double Way(const Eigen::Vector3d& point, const Eigen::Vector3d& direction, double enough) const;
  // How deep the point lies inside: the distance to the nearest plane; 0 outside. Stops at the
  // first plane within `enough`, and returns no more than that then.
  double Depth(const Eigen::Vector3d& point, double enough = 0.0) const;
};

ConvexPart MakeConvexPart(const std::vector<Eigen::Vector3d>& points);

}  // namespace antigrasp
