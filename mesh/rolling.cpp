#include "antigrasp/mesh/rolling.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include "antigrasp/mesh/point_tree.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Share of the hull's size that rounding stays below.
constexpr double kRounding = 1e-13;

// What the object rolls over: a point of an edge, or a corner at the end of one.
struct Pivot {
  Vector3d point;
  Vector3d outward;  // horizontal, from the pivot to below the centre of mass; not unit
  std::array<std::int32_t, 2> ends;  // of the edge; twice the corner

  bool AtCorner() const { return ends[0] == ends[1]; }
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
    const std::int32_t from = share >= 1.0 ? side.to : side.from;
    const std::int32_t to = share <= 0.0 ? side.from : side.to;
    nearest = {point, foot - point, {from, to}};
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

// The numbers of the vertices that share an edge with a vertex of a closed mesh.
class VertexNeighbours {
 public:
  explicit VertexNeighbours(const TriangleMesh& mesh)
      : first_(mesh.vertices.size() + 1, 0), all_(3 * mesh.faces.size()) {
    for (const auto& face : mesh.faces) {
      for (const std::int32_t from : face) ++first_[static_cast<std::size_t>(from)];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (const auto& face : mesh.faces) {  // backwards into the places that the sums leave
      for (std::size_t k = 0; k < 3; ++k) {
        all_[--first_[static_cast<std::size_t>(face[k])]] = face[(k + 1) % 3];
      }
    }
  }
  std::span<const std::int32_t> Of(std::int32_t vertex) const {
    const std::size_t first = first_[static_cast<std::size_t>(vertex)];
    return {all_.data() + first, first_[static_cast<std::size_t>(vertex) + 1] - first};
  }

 private:
  std::vector<std::size_t> first_;
  std::vector<std::int32_t> all_;
};

// A turn over the pivot.
struct Turn {
  Pivot pivot;
  Vector3d down, outward;  // before; unit
  double spot;             // corners nearer to the axis than this turn on the spot

  // The angle until the corner is on the table; infinity for one that turns on the spot.
  double Until(const Vector3d& corner) const {
    const Vector3d arm = corner - pivot.point;
    const double above = std::max(0.0, -arm.dot(down));
    const double ahead = arm.dot(outward);
    if (std::hypot(above, ahead) <= spot) return std::numeric_limits<double>::infinity();
    return std::atan2(above, ahead);
  }
  Vector3d DownAfter(double angle) const {
    return std::cos(angle) * down + std::sin(angle) * outward;
  }
};

// The corner that comes down first, the pivot itself (-1) when none does.
struct Touch {
  Vector3d point;
  double angle = std::numbers::pi;
  std::int32_t corner = -1;
};

std::vector<Vector3d> Normals(const std::vector<Facet>& facets) {
  std::vector<Vector3d> normals;
  normals.reserve(facets.size());
  for (const Facet& facet : facets) normals.push_back(facet.normal);
  return normals;
}

// The hull with what finds the next corner and the facet that faces down: looking at all of them
// for every step takes hours when every vertex of a scan lies on the hull.
class Roller {
 public:
  explicit Roller(const FacetedHull& hull)
      : hull_(hull),
        normals_(Normals(hull.facets)),
        neighbours_(hull.mesh),
        corner_tree_(hull.mesh.vertices),
        normal_tree_(normals_) {}

  // The facet that the object comes to lie on next, from a facet that does not carry it. `side` is
  // the side that the centre of mass is nearest to or beyond, by `margin`.
  std::size_t RollFrom(const Facet& facet, double margin, const Segment& side) const;

 private:
  std::optional<Touch> NeighbourTouch(const Turn& turn) const;
  Touch FirstTouch(const Turn& turn) const;
  std::size_t FacetFacing(const Vector3d& down) const;

  const FacetedHull& hull_;
  std::vector<Vector3d> normals_;
  VertexNeighbours neighbours_;
  PointTree corner_tree_, normal_tree_;
};

// A convex object comes down next on a neighbour of what it turns about, and on that one alone when
// all others of the neighbours of both are above the table then. nullopt where roundings count:
// several come down at once, or the hull is not convex at the scale of the tolerances.
std::optional<Touch> Roller::NeighbourTouch(const Turn& turn) const {
  const std::array<std::int32_t, 2>& ends = turn.pivot.ends;
  const double rounding = kRounding * hull_.size;
  Touch touch{turn.pivot.point};
  const auto arm = [&](std::int32_t corner) -> Vector3d {
    return hull_.mesh.vertices[static_cast<std::size_t>(corner)] - turn.pivot.point;
  };
  const auto is_end = [&](std::int32_t corner) { return corner == ends[0] || corner == ends[1]; };
  const auto come_down = [&](std::int32_t end) {
    for (const std::int32_t next : neighbours_.Of(end)) {
      if (is_end(next)) continue;
      const Vector3d& point = hull_.mesh.vertices[static_cast<std::size_t>(next)];
      const double angle = turn.Until(point);
      if (std::isinf(angle) || arm(next).dot(turn.down) > 0.1 * rounding) return false;
      if (angle < touch.angle) touch = {point, angle, next};
    }
    return true;
  };
  const std::size_t count = turn.pivot.AtCorner() ? 1 : 2;
  for (std::size_t k = 0; k < count; ++k) {
    if (!come_down(ends[k])) return {};
  }
  if (touch.corner < 0) return {};
  const Vector3d after = turn.DownAfter(touch.angle);
  const auto clear = [&](std::int32_t of) {
    const auto all = neighbours_.Of(of);
    return std::all_of(all.begin(), all.end(), [&](std::int32_t next) {
      return is_end(next) || next == touch.corner || arm(next).dot(after) < -rounding;
    });
  };
  for (std::size_t k = 0; k < count; ++k) {
    if (!clear(ends[k]) || std::abs(arm(ends[k]).dot(after)) > rounding) return {};
  }
  if (!clear(touch.corner)) return {};
  return touch;
}

// Of several corners that come down at one angle the first. A box is left out when it has nothing
// below the plane that the table is in after the least angle so far.
Touch Roller::FirstTouch(const Turn& turn) const {
  // Only where the object goes on from the corner does it matter which one of a whole facet that
  // comes down at once is the first.
  const double rounding = (turn.pivot.AtCorner() ? -kRounding : kRounding) * hull_.size;
  Touch touch{turn.pivot.point};
  Vector3d after = -turn.down;
  const auto open = [&](const PointTree::Box& box) {
    if (box.Reach(after) - turn.pivot.point.dot(after) >= rounding) return true;
    // Past a right angle corners that are a little below the table already count as on it.
    return touch.angle > 0.5 * std::numbers::pi &&
           box.Reach(turn.down) - turn.pivot.point.dot(turn.down) >= -kRounding * hull_.size;
  };
  const auto see = [&](std::size_t i) {
    const Vector3d& point = hull_.mesh.vertices[i];
    const double angle = turn.Until(point);
    const auto corner = static_cast<std::int32_t>(i);
    if (angle > touch.angle || (angle == touch.angle && corner >= touch.corner)) return;
    touch = {point, angle, corner};
    after = turn.DownAfter(angle);
  };
  corner_tree_.Search(turn.pivot.point, open, see);
  return touch;
}

// The first of those whose normal is nearest to `down`.
std::size_t Roller::FacetFacing(const Vector3d& down) const {
  double most = -std::numeric_limits<double>::infinity();
  std::size_t facing = 0;
  normal_tree_.Search(
      down, [&](const PointTree::Box& box) { return box.Reach(down) >= most - kRounding; },
      [&](std::size_t f) {
        const double dot = normals_[f].dot(down);
        if (dot < most || (dot == most && f >= facing)) return;
        most = dot;
        facing = f;
      });
  return facing;
}

std::size_t Roller::RollFrom(const Facet& facet, double margin, const Segment& side) const {
  Vector3d down = facet.normal;
  Pivot pivot = NearestPivot(facet.border, facet.height * down);
  if (margin > -kBalance * hull_.size) {  // balanced above the side: falls straight across it
    pivot = {side.a, (side.b - side.a).cross(down), {side.from, side.to}};
  }
  // Over a corner the object first lands on an edge. Every step sinks; the limit is for rounding.
  for (int step = 0; step < 100; ++step) {
    const Turn turn{pivot, down, pivot.outward.normalized(), 2.0 * kFlat * hull_.size};
    std::optional<Touch> touch = NeighbourTouch(turn);
    if (!touch) touch = FirstTouch(turn);
    down = turn.DownAfter(touch->angle).normalized();
    if (!pivot.AtCorner()) break;
    const Segment edge{pivot.point, touch->point, pivot.ends[0], touch->corner};
    pivot = NearestPivot({edge}, edge.a.dot(down) * down);
    if (!(pivot.outward.norm() > kBalance * hull_.size)) {
      pivot.outward = (edge.b - edge.a).cross(down);
    }
  }
  return FacetFacing(down);
}

}  // namespace

// From the lowest centre of mass upwards: it only ever sinks, so that the next facet's answer is
// known already.
std::vector<std::size_t> RestingFacets(const FacetedHull& hull) {
  std::vector<std::size_t> by_height(hull.facets.size());
  std::iota(by_height.begin(), by_height.end(), std::size_t{0});
  std::stable_sort(by_height.begin(), by_height.end(), [&](std::size_t f, std::size_t g) {
    return hull.facets[f].height < hull.facets[g].height;
  });
  const Roller roller(hull);
  std::vector<std::size_t> resting(hull.facets.size());
  for (const std::size_t f : by_height) {
    const Facet& facet = hull.facets[f];
    resting[f] = f;
    const Segment* side = nullptr;
    const double margin = Margin(facet, &side);
    if (margin > kBalance * hull.size) continue;
    const std::size_t next = roller.RollFrom(facet, margin, *side);
    if (hull.facets[next].height < facet.height) resting[f] = resting[next];
  }
  return resting;
}

}  // namespace antigrasp
