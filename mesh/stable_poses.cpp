#include "antigrasp/mesh/stable_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

#include "antigrasp/mesh/convex_hull.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Shares of the object's size: how far a facet may be from flat, and how far inside a facet the
// centre of mass must stand for the pose to be stable.
constexpr double kFlat = 1e-5;
constexpr double kBalance = 1e-6;

struct Segment {
  Vector3d a, b;
};

// A flat facet of the hull; everything relative to the centre of mass.
struct Facet {
  Vector3d normal = Vector3d::Zero();  // outward unit
  double height = 0.0;                 // of the centre of mass above it
  double solid_angle = 0.0;            // seen from the centre of mass
  std::vector<Segment> border;         // counter-clockwise seen from outside
};

struct Hull {
  TriangleMesh mesh;  // centre of mass at the origin
  double size = 0.0;
  std::vector<Facet> facets;
};

std::array<Vector3d, 3> Corners(const TriangleMesh& mesh, std::size_t face) {
  std::array<Vector3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = mesh.vertices[static_cast<std::size_t>(mesh.faces[face][k])];
  }
  return corners;
}

// Of a triangle seen from the origin, positive when the origin is behind it (van Oosterom and
// Strackee, "The solid angle of a plane triangle", 1983).
double SolidAngle(const std::array<Vector3d, 3>& t) {
  const double a = t[0].norm(), b = t[1].norm(), c = t[2].norm();
  return 2.0 * std::atan2(t[0].dot(t[1].cross(t[2])),
                          a * b * c + t[0].dot(t[1]) * c + t[1].dot(t[2]) * a + t[2].dot(t[0]) * b);
}

// Face numbers across the three sides of every face of a closed mesh, sides as in mesh.faces.
std::vector<std::array<std::size_t, 3>> Neighbours(const TriangleMesh& mesh) {
  std::vector<std::array<std::size_t, 3>> neighbours(mesh.faces.size());
  const auto put = [&](const EdgeUse& use, std::size_t across) {
    const auto face = static_cast<std::size_t>(use.face);
    const std::int32_t from = use.forward ? use.low : use.high;
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.faces[face][k] == from) neighbours[face][k] = across;
    }
  };
  const std::vector<EdgeUse> uses = SortedEdgeUses(mesh);
  ForEachEdge(uses, [&](auto first, auto) {
    put(first[0], static_cast<std::size_t>(first[1].face));
    put(first[1], static_cast<std::size_t>(first[0].face));
  });
  return neighbours;
}

// For every hull triangle the number of its facet. A facet grows from its largest triangle over
// neighbours near that triangle's plane; measuring from the one plane keeps round shapes round.
std::vector<int> GroupFlat(const TriangleMesh& hull, double tolerance,
                           const std::vector<std::array<std::size_t, 3>>& neighbours) {
  std::vector<double> area(hull.faces.size());
  for (std::size_t f = 0; f < area.size(); ++f) area[f] = FaceCross(hull, f).norm();
  std::vector<std::size_t> by_area(area.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::size_t f, std::size_t g) { return area[f] > area[g]; });
  std::vector<int> group(area.size(), -1);
  int count = 0;
  for (const std::size_t seed : by_area) {
    if (group[seed] >= 0) continue;
    const Vector3d normal = FaceCross(hull, seed).normalized();
    const double offset = normal.dot(Corners(hull, seed)[0]);
    std::vector<std::size_t> open{seed};
    group[seed] = count;
    while (!open.empty()) {
      const std::size_t face = open.back();
      open.pop_back();
      for (const std::size_t next : neighbours[face]) {
        const auto corners = Corners(hull, next);
        const bool flat = std::all_of(corners.begin(), corners.end(), [&](const Vector3d& v) {
          return std::abs(normal.dot(v) - offset) <= tolerance;
        });
        if (group[next] >= 0 || !flat) continue;
        group[next] = count;
        open.push_back(next);
      }
    }
    ++count;
  }
  return group;
}

std::vector<Facet> FlatFacets(const TriangleMesh& hull, double size) {
  const auto neighbours = Neighbours(hull);
  const std::vector<int> group = GroupFlat(hull, kFlat * size, neighbours);
  std::vector<Facet> facets(static_cast<std::size_t>(
      group.empty() ? 0 : *std::max_element(group.begin(), group.end()) + 1));
  for (std::size_t f = 0; f < group.size(); ++f) {
    Facet& facet = facets[static_cast<std::size_t>(group[f])];
    const auto corners = Corners(hull, f);
    facet.normal += FaceCross(hull, f);
    facet.solid_angle += SolidAngle(corners);
    for (std::size_t k = 0; k < 3; ++k) {
      if (group[neighbours[f][k]] != group[f]) {
        facet.border.push_back({corners[k], corners[(k + 1) % 3]});
      }
    }
  }
  for (Facet& facet : facets) {
    facet.normal.normalize();
    for (const Segment& side : facet.border) {
      facet.height = std::max(facet.height, facet.normal.dot(side.a));
    }
  }
  return facets;
}

Hull MakeHull(const TriangleMesh& mesh, const Vector3d& com) {
  Hull hull;
  hull.mesh = Transformed(ConvexHull(mesh.vertices), 1.0, -com);
  hull.size = Bounds(hull.mesh).Extent().norm();
  hull.facets = FlatFacets(hull.mesh, hull.size);
  return hull;
}

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
std::pair<Vector3d, double> FirstTouch(const Hull& hull, const Vector3d& down, const Pivot& pivot,
                                       const Vector3d& outward) {
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

std::size_t FacetFacing(const Hull& hull, const Vector3d& down) {
  const auto best = std::max_element(
      hull.facets.begin(), hull.facets.end(),
      [&](const Facet& f, const Facet& g) { return f.normal.dot(down) < g.normal.dot(down); });
  return static_cast<std::size_t>(best - hull.facets.begin());
}

// The facet that the object comes to lie on next, from a facet that does not carry it. `side` is
// the side that the centre of mass is nearest to or beyond.
std::size_t RollFrom(const Hull& hull, const Facet& facet, double margin, const Segment& side) {
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

// For every facet the one that the object rests on after landing on it. From the lowest centre of
// mass upwards: it only ever sinks, so that the next facet's answer is known already.
std::vector<std::size_t> RestingFacets(const Hull& hull) {
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

Eigen::Matrix3d TableFromObject(const Vector3d& up) {
  const Vector3d level(-up.y(), up.x(), 0.0);
  const Vector3d x = level.norm() > 0.0 ? level.normalized() : Vector3d::UnitX();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), up.cross(x).transpose(), up.transpose();
  return rotation.array() + 0.0;  // no negative zeros
}

// CGAL triangulates a flat facet in an order that follows from addresses, and the last bits of sums
// over it with that. They are cut off here, so that equal meshes have equal poses.
constexpr double kKept = 0x1p44;  // of 2^53
double WithoutLastBits(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(kKept * mantissa) / kKept, exponent);
}
Vector3d WithoutLastBits(const Vector3d& unit) { return (kKept * unit).array().round() / kKept; }

// The poses of a symmetric object are equally likely but for rounding: these in an order that
// rounding cannot change.
bool LikelierFirst(const StablePose& a, const StablePose& b) {
  const auto key = [](const StablePose& pose) {
    const Vector3d up = (1e6 * pose.table_from_object.row(2).transpose()).array().round() + 0.0;
    return std::tuple(-std::round(1e9 * pose.probability), up.x(), up.y(), up.z());
  };
  return key(a) < key(b);
}

}  // namespace

std::vector<StablePose> StablePoses(const TriangleMesh& mesh, const Vector3d& com) {
  const Hull hull = MakeHull(mesh, com);
  const bool inside = std::all_of(hull.facets.begin(), hull.facets.end(),
                                  [](const Facet& facet) { return facet.height > 0.0; });
  if (hull.facets.empty() || !inside) return {};
  const std::vector<std::size_t> resting = RestingFacets(hull);
  std::vector<StablePose> by_facet(hull.facets.size());
  for (std::size_t f = 0; f < resting.size(); ++f) {
    const Facet& facet = hull.facets[resting[f]];
    StablePose& pose = by_facet[resting[f]];
    pose.probability += hull.facets[f].solid_angle / (4.0 * std::numbers::pi);
    pose.table_from_object = TableFromObject(WithoutLastBits(Vector3d(-facet.normal)).normalized());
    pose.com_height = WithoutLastBits(facet.height);
  }
  for (StablePose& pose : by_facet) pose.probability = WithoutLastBits(pose.probability);
  std::erase_if(by_facet, [](const StablePose& pose) { return pose.probability <= 0.0; });
  std::stable_sort(by_facet.begin(), by_facet.end(), LikelierFirst);
  return by_facet;
}

}  // namespace antigrasp
