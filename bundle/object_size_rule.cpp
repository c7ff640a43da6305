#include "antigrasp/bundle/object_size_rule.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "antigrasp/mesh/convex_hull.h"

namespace antigrasp {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kShortest = 0.8;  // of the opening
// Of a hull of many facets the largest are tried: of a round shape any two are alike, and on one
// with flat sides these are the largest.
constexpr std::size_t kMostFacets = 1000;
constexpr double kOnePlane = 1e-12;  // 1 less the cosine between the normals of a facet

double WidthAlong(const std::vector<Vector3d>& points, const Vector3d& axis) {
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Vector3d& point : points) {
    low = std::min(low, axis.dot(point));
    high = std::max(high, axis.dot(point));
  }
  return high - low;
}

// Twice its area along its normal; the largest first. The triangles of a facet are a fan about its
// first corner (mesh/convex_hull.h).
std::vector<Vector3d> LargestFacets(const TriangleMesh& hull) {
  std::vector<Vector3d> facets;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const Vector3d cross = FaceCross(hull, f);
    const bool same = f > 0 && hull.faces[f][0] == hull.faces[f - 1][0] &&
                      cross.normalized().dot(facets.back().normalized()) > 1.0 - kOnePlane;
    if (same) {
      facets.back() += cross;
    } else {
      facets.push_back(cross);
    }
  }
  std::stable_sort(facets.begin(), facets.end(), [](const Vector3d& a, const Vector3d& b) {
    return a.squaredNorm() > b.squaredNorm();
  });
  facets.resize(std::min(facets.size(), kMostFacets));
  return facets;
}

// The corners of the convex hull of points in a plane, counter-clockwise (Andrew's monotone chain).
std::vector<Vector2d> Outline(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  std::vector<Vector2d> corners;
  const auto turns_left = [&](const Vector2d& next) {
    const Vector2d& last = corners.back();
    const Vector2d a = last - corners[corners.size() - 2], b = next - last;
    return a.x() * b.y() - a.y() * b.x() > 0.0;
  };
  const auto chain = [&](const auto& first, const auto& end) {
    const std::size_t begin = corners.size();
    for (auto point = first; point != end; ++point) {
      while (corners.size() >= begin + 2 && !turns_left(*point)) corners.pop_back();
      corners.push_back(*point);
    }
    corners.pop_back();  // begins the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return corners;
}

// The sides of the smallest rectangle around a convex outline, which lies flush with an edge of it
// (Freeman & Shapira 1975). Its other sides touch corners that go around as the edge does
// (Toussaint 1983: calipers).
Vector2d SmallestRectangle(const std::vector<Vector2d>& outline) {
  const std::size_t n = outline.size();
  const auto corner = [&](std::size_t i) -> const Vector2d& { return outline[i % n]; };
  // From `from` on, the first corner after which it goes no further that way.
  const auto furthest = [&](const Vector2d& way, std::size_t from, std::size_t last) {
    while (from < last && way.dot(corner(from + 1) - corner(from)) > 0.0) ++from;
    return from;
  };
  Vector2d sides = Vector2d::Zero();
  double least = std::numeric_limits<double>::max();
  std::size_t right = 0, top = 0, left = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d edge = corner(i + 1) - corner(i);
    if (!(edge.squaredNorm() > 0.0)) continue;
    const Vector2d x = edge.normalized(), y(-x.y(), x.x());
    right = furthest(x, std::max(right, i + 1), i + n);
    top = furthest(y, std::max(top, right), i + n);
    left = furthest(-x, std::max(left, top), i + n);
    const Vector2d found(x.dot(corner(right) - corner(left)), y.dot(corner(top) - corner(i)));
    if (found.prod() >= least) continue;
    sides = found;
    least = sides.prod();
  }
  return sides;
}

}  // namespace

Vector3d OrientedExtents(const TriangleMesh& mesh) {
  const TriangleMesh hull = ConvexHullOfCorners(mesh.vertices);
  double least = std::numeric_limits<double>::max();
  Vector3d extents = Vector3d::Zero();
  std::vector<Vector2d> flat(hull.vertices.size());
  for (const Vector3d& facet : LargestFacets(hull)) {
    if (!(facet.norm() > 0.0)) continue;
    const Vector3d up = facet.normalized(), x = up.unitOrthogonal(), y = up.cross(x);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      flat[i] = {x.dot(hull.vertices[i]), y.dot(hull.vertices[i])};
    }
    const Vector2d sides = SmallestRectangle(Outline(flat));
    const Vector3d found(WidthAlong(hull.vertices, up), sides.x(), sides.y());
    if (found.prod() >= least) continue;
    least = found.prod();
    extents = found;
  }
  std::sort(extents.data(), extents.data() + 3);
  return extents;
}

double EgadScale(const Vector3d& oriented_extents, double opening) {
  const double scale = opening / oriented_extents.maxCoeff();
  return std::min(scale, kShortest * opening / oriented_extents.minCoeff());
}

}  // namespace antigrasp
