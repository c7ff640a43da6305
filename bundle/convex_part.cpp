#include "antigrasp/bundle/convex_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "antigrasp/mesh/convex_hull.h"

namespace antigrasp {
namespace {

constexpr double kOnePlane = 1e-6;  // of the size

bool Known(const std::vector<HalfSpace>& planes, const HalfSpace& plane, double near) {
  // Neighbours come close together in the list: facets are sorted by their corners.
  const auto first = planes.rbegin(), last = planes.rend();
  return std::any_of(first, last, [&](const HalfSpace& other) {
    return std::abs(other.offset - plane.offset) <= near &&
           (other.normal - plane.normal).squaredNorm() <= kOnePlane * kOnePlane;
  });
}

}  // namespace

double ConvexPart::Depth(const Eigen::Vector3d& point, double enough) const {
  if (empty() || (point.array() <= box.min.array()).any() ||
      (point.array() >= box.max.array()).any()) {
    return 0.0;
  }
  double depth = std::numeric_limits<double>::max();
  for (const HalfSpace& plane : planes) {
    depth = std::min(depth, -plane.Outside(point));
    if (depth <= enough) return std::max(depth, 0.0);
  }
  return depth;
}

double ConvexPart::Way(const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                       double enough) const {
  if (empty() || (point.array() <= box.min.array()).any() ||
      (point.array() >= box.max.array()).any()) {
    return 0.0;
  }
  double way = std::numeric_limits<double>::max();
  for (const HalfSpace& plane : planes) {
    const double depth = -plane.Outside(point), slope = plane.normal.dot(direction);
    if (depth <= 0.0) return 0.0;
    if (slope * way > depth) way = depth / slope;
    if (way <= enough) return way;
  }
  return way;
}

ConvexPart MakeConvexPart(const std::vector<Eigen::Vector3d>& points) {
  ConvexPart part;
  part.mesh = ConvexHullOfCorners(points);
  part.box = Bounds(part.mesh);
  const double size = part.box.Extent().norm();
  for (std::size_t f = 0; f < part.mesh.faces.size(); ++f) {
    const Eigen::Vector3d cross = FaceCross(part.mesh, f);
    if (!(cross.norm() > kOnePlane * kOnePlane * size * size))
      continue;  // an edge's neighbours say more
    HalfSpace plane{cross.normalized(), 0.0};
    plane.offset =
        plane.normal.dot(part.mesh.vertices[static_cast<std::size_t>(part.mesh.faces[f][0])]);
    if (!Known(part.planes, plane, kOnePlane * size)) part.planes.push_back(plane);
  }
  if (part.planes.size() < 4) return {};
  part.volume = Volume(part.mesh);
  return part;
}

}  // namespace antigrasp
