#include "tests/mesh/plain_rolling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// What the object rolls over: a point of an edge, or a corner at the end of one.
struct Pivot {
  Vector3d point;
  Vector3d outward;  // horizontal, from the pivot to below the centre of mass; not unit
  bool corner = false;
};

// The point of the contact nearest to `foot`, which is below the centre of mass.
Pivot NearestPivot(const std::vector<Segment>& contact, const Vector3d& foot) {
  Pivot nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& side : contact) {
    const Vector3d along = side.b - side.a;
    const double share = std::clamp(along.dot(foot - side.a) / along.squaredNorm(), 0.0, 1.0);
    const Vector3d point = side.a + share * along;
    const double distance = (foot - point).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = {point, foot - point, share <= 0.0 || share >= 1.0};
  }
  return nearest;
}

// How far inside the facet the centre of mass stands: the distance to the nearest side, negative
// outside. `side` is that side.
double Margin(const Facet& facet, const Segment** side) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& s : facet.border) {
    const double inside = facet.normal.dot((s.b - s.a).normalized().cross(-s.a));
    if (inside >= least) continue;
    least = inside;
    *side = &s;
  }
  return least;
}

// The corner that comes down first when the object turns about the pivot towards `outward` (unit),
// and the angle until then.
std::pair<Vector3d, double> FirstTouch(const FacetedHull& hull, const Vector3d& down,
                                       const Pivot& pivot, const Vector3d& outward) {
  Vector3d touching = pivot.point;
  double least = std::numbers::pi;
  for (const Vector3d& corner : hull.mesh.vertices) {
    const Vector3d arm = corner - pivot.point;
    const double above = std::max(0.0, -arm.dot(down));
    const double ahead = arm.dot(outward);
    if (std::hypot(above, ahead) <= 2.0 * kFlat * hull.size) continue;  // turns on the spot
    const double angle = std::atan2(above, ahead);
    if (angle >= least) continue;
    least = angle;
    touching = corner;
  }
  return {touching, least};
}

std::size_t FacetFacing(const FacetedHull& hull, const Vector3d& down) {
  const auto best = std::max_element(
      hull.facets.begin(), hull.facets.end(),
      [&](const Facet& f, const Facet& g) { return f.normal.dot(down) < g.normal.dot(down); });
  return static_cast<std::size_t>(best - hull.facets.begin());
}

// The facet that the object comes to lie on next, from a facet that does not carry it. `side` is
// the side that the centre of mass is nearest to or beyond.
std::size_t RollFrom(const FacetedHull& hull, const Facet& facet, double margin,
                     const Segment& side) {
  Vector3d down = facet.normal;
  Pivot pivot = NearestPivot(facet.border, facet.height * down);
  if (margin > -kBalance * hull.size) {  // balanced above the side: falls straight across it
    pivot = {side.a, (side.b - side.a).cross(down), false};
  }
  // Over a corner the object first lands on an edge. Every step sinks; the limit is for rounding.
  for (int step = 0; step < 100; ++step) {
    const Vector3d outward = pivot.outward.normalized();
    const auto [touching, angle] = FirstTouch(hull, down, pivot, outward);
    down = (std::cos(angle) * down + std::sin(angle) * outward).normalized();
    if (!pivot.corner) break;
    const Segment edge{pivot.point, touching};
    pivot = NearestPivot({edge}, edge.a.dot(down) * down);
    if (!(pivot.outward.norm() > kBalance * hull.size)) {
      pivot.outward = (edge.b - edge.a).cross(down);
    }
  }
  return FacetFacing(hull, down);
}

}  // namespace

std::vector<std::size_t> PlainRestingFacets(const FacetedHull& hull) {
  std::vector<std::size_t> by_height(hull.facets.size());
  std::iota(by_height.begin(), by_height.end(), std::size_t{0});
  std::stable_sort(by_height.begin(), by_height.end(), [&](std::size_t f, std::size_t g) {
    return hull.facets[f].height < hull.facets[g].height;
  });
  std::vector<std::size_t> resting(hull.facets.size());
  for (const std::size_t f : by_height) {
    const Facet& facet = hull.facets[f];
    resting[f] = f;
    const Segment* side = nullptr;
    const double margin = Margin(facet, &side);
    if (margin > kBalance * hull.size) continue;
    const std::size_t next = RollFrom(hull, facet, margin, *side);
    if (hull.facets[next].height < facet.height) resting[f] = resting[next];
  }
  return resting;
}

}  // namespace antigrasp
