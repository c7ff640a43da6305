#include "antigrasp/bundle/object_size_rule.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "antigrasp/bundle/convex_part.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kShortest = 0.8;  // of the opening

double WidthAlong(const std::vector<Vector3d>& points, const Vector3d& axis) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Vector3d& point : points) {
    low = std::min(low, axis.dot(point));
    high = std::max(high, axis.dot(point));
  }
  return high - low;
}

}  // namespace

Vector3d OrientedExtents(const TriangleMesh& mesh) {
  const ConvexPart hull = MakeConvexPart(mesh.vertices);
  const auto& corners = hull.mesh.vertices;
  double least = std::numeric_limits<double>::max();
  Vector3d extents = Vector3d::Zero();
  for (const HalfSpace& plane : hull.planes) {
    const Vector3d& up = plane.normal;
    const double height = WidthAlong(corners, up);
    // The smallest rectangle is flush with an edge of the outline; edges of the hull are tried.
    for (const HalfSpace& other : hull.planes) {
      const Vector3d side = other.normal - up * up.dot(other.normal);
      if (side.norm() < 1e-6) continue;
      const Vector3d x = side.normalized();
      const Vector3d found(height, WidthAlong(corners, x), WidthAlong(corners, up.cross(x)));
      if (found.prod() < least) {
        least = found.prod();
        extents = found;
      }
    }
  }
  std::sort(extents.data(), extents.data() + 3);
  return extents;
}

double EgadScale(const Vector3d& oriented_extents, double opening) {
  const double scale = opening / oriented_extents.maxCoeff();
  return std::min(scale, kShortest * opening / oriented_extents.minCoeff());
}

}  // namespace antigrasp
