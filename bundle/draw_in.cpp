#include "antigrasp/bundle/draw_in.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "antigrasp/bundle/surface_points.h"
#include "antigrasp/mesh/convex_hull.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kFacetApart = 0.5;  // cells between the points of a facet
constexpr double kDeepest = 1.0;     // cells
constexpr double kAir = 0.02;        // cells: shallower air is none
constexpr double kRoom = 0.01;       // cells: what is thinner is gone
constexpr double kOnFacet = 1e-6;    // of the size
constexpr double kLost = 0.4;        // cells that a corner may come to lie outside
constexpr int kShares = 3;           // each half of the one before
constexpr int kSteps = 200;
constexpr double kOver = 1.2;  // of the way to a plane

bool InOther(const std::vector<ConvexPart>& parts, std::size_t but, const Vector3d& point) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i != but && parts[i].Depth(point) > 0.0) return true;
  }
  return false;
}

// How far the solid is below each plane's facet at most, where it is in the air and in no other
// part.
std::vector<double> AirBelow(const std::vector<ConvexPart>& parts, std::size_t which,
                             const SolidTest& solid, double cell) {
  const ConvexPart& part = parts[which];
  std::vector<double> air(part.planes.size(), 0.0);
  const double near = kOnFacet * part.box.Extent().norm();
  for (const Vector3d& middle : PointsOf(Refined(part.mesh, kFacetApart * cell)).middles) {
    if (solid.Inside(middle) || InOther(parts, which, middle)) continue;
    const double depth = std::min(solid.Distance(middle), kDeepest * cell);
    for (std::size_t k = 0; k < air.size(); ++k) {
      if (part.planes[k].Outside(middle) > -near) air[k] = std::max(air[k], depth);
    }
  }
  return air;
}

// A point behind all planes by `room`, near `start`: always back over the plane that is missed by
// most (Motzkin's relaxation).
std::optional<Vector3d> PointBehind(const std::vector<HalfSpace>& planes, Vector3d start,
                                    double room) {
  for (int step = 0; step < kSteps; ++step) {
    const auto worst =
        std::max_element(planes.begin(), planes.end(), [&](const HalfSpace& a, const HalfSpace& b) {
          return a.Outside(start) < b.Outside(start);
        });
    const double missed = worst->Outside(start) + room;
    if (missed <= 0.0) return start;
    start -= kOver * missed * worst->normal;
  }
  return std::nullopt;
}

ConvexPart DrawnInPart(const ConvexPart& part, const std::vector<double>& air, double share,
                       double cell) {
  std::vector<HalfSpace> planes = part.planes;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (air[k] > kAir * cell) planes[k].offset -= share * air[k];
  }
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& corner : part.mesh.vertices) {
    middle += corner / static_cast<double>(part.mesh.vertices.size());
  }
  const auto inside = PointBehind(planes, middle, kRoom * cell);
  return inside ? Behind(planes, *inside) : ConvexPart{};
}

// How far the corners of a part come to lie outside of all others and of what is left of it.
double Loss(const ConvexPart& before, const std::vector<ConvexPart>& parts, std::size_t which,
            const ConvexPart& left) {
  double loss = 0.0;
  for (const Vector3d& corner : before.mesh.vertices) {
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const ConvexPart& part = i == which ? left : parts[i];
      if (part.empty()) continue;
      double outside = 0.0;
      for (const HalfSpace& plane : part.planes) {
        outside = std::max(outside, plane.Outside(corner));
      }
      least = std::min(least, outside);
    }
    loss = std::max(loss, least);
  }
  return loss;
}

}  // namespace

ConvexPart Behind(const std::vector<HalfSpace>& planes, const Vector3d& inside) {
  // A facet of the hull of the dual points is a corner of what is behind the planes.
  std::vector<Vector3d> duals;
  for (const HalfSpace& plane : planes) duals.push_back(plane.normal / -plane.Outside(inside));
  const TriangleMesh hull = ConvexHullOfCorners(duals);
  std::vector<Vector3d> corners;
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const Vector3d normal = FaceCross(hull, f).normalized();
    const double height = normal.dot(hull.vertices[static_cast<std::size_t>(hull.faces[f][0])]);
    if (height > 0.0) corners.push_back(inside + normal / height);
  }
  return MakeConvexPart(corners);
}

std::vector<ConvexPart> DrawnIn(std::vector<ConvexPart> parts, const SolidTest& solid, double share,
                                double cell) {
  const std::vector<ConvexPart> before = parts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::vector<double> air = AirBelow(before, i, solid, cell);
    if (*std::max_element(air.begin(), air.end()) <= kAir * cell) continue;
    double by = share;
    for (int k = 0; k < kShares; ++k, by *= 0.5) {
      ConvexPart part = DrawnInPart(before[i], air, by, cell);
      if (Loss(before[i], parts, i, part) > kLost * cell) continue;
      parts[i] = std::move(part);
      break;
    }
  }
  std::erase_if(parts, [](const ConvexPart& part) { return part.empty(); });
  return parts;
}

}  // namespace antigrasp
