#include "antigrasp/perturb/face_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/perturb/cone.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Nearer than this share of the faces' size, p and q are one point (a shared corner, rounded).
constexpr double kSamePoint = 1e-12;
// A plane separates two shapes when it does so by this share of their distance.
constexpr double kPlaneSlack = 1e-11;
// Below this share of its squared size a face's area is rounding noise.
constexpr double kNoArea = 1e-12;

// The directions that both contacts hold: within psi of both axes.
struct Lens {
  Lens(const FaceShape& first, const FaceShape& second, double psi)
      : inward(-first.normal, psi), outward(second.normal, psi) {}
  bool Contains(const Vector3d& direction) const {
    return inward.Contains(direction) && outward.Contains(direction);
  }
  Cone inward;   // at the first contact
  Cone outward;  // at the second
};

// The nine differences of corners, which are the corners of D = second - first.
using Differences = std::array<std::array<Vector3d, 3>, 3>;  // [of the first][of the second]

Differences DifferencesOf(const FaceShape& first, const FaceShape& second) {
  Differences d;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) d[i][j] = second.corner[j] - first.corner[i];
  }
  return d;
}

// The part of from + s * (to - from), s in [0, 1], in the lens. Where a segment begins or ends in
// the origin (a shared corner) the origin itself does not count.
Range ClipToLens(const Vector3d& from, const Vector3d& to, const Lens& lens) {
  constexpr Range kNothing{1.0, 0.0};
  if (from.isZero(0.0)) return lens.Contains(to) ? Range{0.0, 1.0} : kNothing;
  if (to.isZero(0.0)) return lens.Contains(from) ? Range{0.0, 1.0} : kNothing;
  const Range range = ClipToCone(from, to - from, lens.inward, {0.0, 1.0});
  return range.empty() ? range : ClipToCone(from, to - from, lens.outward, range);
}

// Calls visit(from, to) for the 18 segments that hold the edges of D, until it returns true.
template <typename Visit>
bool AnySegment(const Differences& d, const Visit& visit) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (visit(d[i][j], d[i][(j + 1) % 3]) || visit(d[i][j], d[(i + 1) % 3][j])) return true;
    }
  }
  return false;
}

template <typename Visit>
bool AnyCorner(const Differences& d, const Visit& visit) {
  return std::any_of(d.begin(), d.end(),
                     [&](const auto& row) { return std::any_of(row.begin(), row.end(), visit); });
}

// Whether the plane that touches the cone where it is nearest to `towards` has all of D beyond it.
bool IsBeyond(const Differences& d, const Vector3d& towards, const Cone& cone, double cosine,
              double sine) {
  const Vector3d sideways = towards - towards.dot(cone.axis) * cone.axis;
  const double length = sideways.norm();
  if (!(length > 0.0)) return false;
  const Vector3d out = cosine / length * sideways - sine * cone.axis;
  const double least = kPlaneSlack * towards.norm();
  return !AnyCorner(d, [&](const Vector3d& corner) { return out.dot(corner) <= least; });
}

// Where the ray from the origin along `direction`, which enters the first face from outside, is in
// D: the second face is clipped to the prism of the first one along that direction.
Range AlongRay(const FaceShape& first, const FaceShape& second, const Vector3d& direction) {
  // Six corners at most, a few more when rounding makes the outline wavy.
  std::array<Vector3d, 9> polygon{second.corner[0], second.corner[1], second.corner[2]};
  std::size_t count = 3;
  for (std::size_t i = 0; i < 3 && count > 0; ++i) {
    const Vector3d side = (first.corner[(i + 1) % 3] - first.corner[i]).cross(direction);
    std::array<Vector3d, 9> kept;
    std::size_t kept_count = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector3d& from = polygon[k];
      const Vector3d& to = polygon[(k + 1) % count];
      const double a = side.dot(from - first.corner[i]), b = side.dot(to - first.corner[i]);
      if (a >= 0.0) kept[kept_count++] = from;
      if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0)) {
        kept[kept_count++] = from + a / (a - b) * (to - from);
      }
    }
    polygon = kept;
    count = kept_count;
  }
  Range range{kUnbounded, -kUnbounded};
  for (std::size_t k = 0; k < count; ++k) {
    const double at = first.normal.dot(polygon[k] - first.corner[0]) / first.normal.dot(direction);
    range = {std::min(range.low, at), std::max(range.high, at)};
  }
  return range;
}

// Directions of the lens that may be nearest to the unit vector `u`, the nearest among them.
Vector3d NearestInLens(const Lens& lens, const Vector3d& u, double psi) {
  if (lens.Contains(u)) return u;
  Vector3d nearest = Vector3d::Zero();
  double best = -2.0;
  const auto offer = [&](const Vector3d& direction) {
    if (direction.dot(u) <= best || !lens.Contains(direction)) return;
    best = direction.dot(u);
    nearest = direction;
  };
  for (const Cone* cone : {&lens.inward, &lens.outward}) {
    const Vector3d& axis = cone->axis;
    const Vector3d towards = u - u.dot(axis) * axis;
    if (towards.norm() > 1e-12) {
      offer(std::cos(psi) * axis + std::sin(psi) * towards.normalized());
    }
  }
  const Vector3d middle = (lens.inward.axis + lens.outward.axis).normalized();
  const Vector3d across = lens.inward.axis.cross(lens.outward.axis);
  const double along = std::min(1.0, std::cos(psi) / middle.dot(lens.inward.axis));
  if (across.norm() > 1e-12) {
    const Vector3d corner = std::sqrt(1.0 - along * along) * across.normalized();
    offer(along * middle + corner);
    offer(along * middle - corner);
  }
  return nearest;
}

// The facet normals of D, up to sign and length.
std::array<Vector3d, 11> FacetNormals(const FaceShape& first, const FaceShape& second) {
  std::array<Vector3d, 11> normals{first.normal, second.normal};
  std::size_t next = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      normals[next++] = (first.corner[(i + 1) % 3] - first.corner[i])
                            .cross(second.corner[(j + 1) % 3] - second.corner[j]);
    }
  }
  return normals;
}

}  // namespace

double AntipodalityAngle(const Vector3d& normal_i, const Vector3d& normal_j) {
  // Of the half-angle formulas the one that is exact near 0, where arccos is not.
  return 2.0 * std::atan2((normal_i + normal_j).norm(), (normal_i - normal_j).norm());
}

FaceShape::FaceShape(const Vector3d& a, const Vector3d& b, const Vector3d& c) : corner{a, b, c} {
  center = (a + b + c) / 3.0;
  const double squared_radius = std::max(
      {(a - center).squaredNorm(), (b - center).squaredNorm(), (c - center).squaredNorm()});
  radius = std::sqrt(squared_radius);
  const Vector3d cross = (b - a).cross(c - a);
  const double length = cross.norm();
  normal = length > kNoArea * squared_radius ? Vector3d(cross / length) : Vector3d::Zero();
}

FaceShape::FaceShape(const TriangleMesh& mesh, std::size_t face)
    : FaceShape(mesh.vertices[mesh.faces[face][0]], mesh.vertices[mesh.faces[face][1]],
                mesh.vertices[mesh.faces[face][2]]) {}

AntipodalTest::AntipodalTest(const PairLimits& limits)
    : limits_(limits),
      cosine_(std::cos(limits.cone_angle)),
      sine_(std::sin(limits.cone_angle)),
      cosine_of_double_(std::cos(2.0 * limits.cone_angle) - kConeSlack) {
  AG_CHECK(limits.cone_angle >= 0.0 && cosine_ > 1e-9, "cone angle in [0, pi / 2)");
  limits_.max_width *= 1.0 + limits.width_slack;
}

// Every q - p is within asin(reach / distance) of the line between the centres: all of them may be
// outside a cone. And the centres are points of the faces themselves.
AntipodalTest::Guess AntipodalTest::ByCenters(const FaceShape& first,
                                              const FaceShape& second) const {
  if (-first.normal.dot(second.normal) < cosine_of_double_) return Guess::kNo;
  if (!first.has_area() || !second.has_area()) return Guess::kNo;
  const Vector3d between = second.center - first.center;
  const double squared = between.squaredNorm(), distance = std::sqrt(squared);
  const double least = std::min(-first.normal.dot(between), second.normal.dot(between));
  if (least > cosine_ * distance && distance <= limits_.max_width) return Guess::kYes;
  const double reach = first.radius + second.radius;
  if (distance <= reach) return Guess::kOpen;
  if (distance - reach > limits_.max_width) return Guess::kNo;
  const double spread = std::sqrt(squared - reach * reach);
  const bool outside = least + kConeSlack * distance < cosine_ * spread - sine_ * reach;
  return outside ? Guess::kNo : Guess::kOpen;
}

bool AntipodalTest::Meet(const FaceShape& first, const FaceShape& second) const {
  const Lens lens(first, second, limits_.cone_angle);
  const Differences d = DifferencesOf(first, second);
  // Two quick answers first; neither decides what the rest would decide otherwise.
  if (AnyCorner(d, [&](const Vector3d& corner) { return lens.Contains(corner); })) return true;
  const Vector3d between = second.center - first.center;
  if (IsBeyond(d, between, lens.inward, cosine_, sine_) ||
      IsBeyond(d, between, lens.outward, cosine_, sine_)) {
    return false;
  }
  const Vector3d middle = (second.normal - first.normal).normalized();
  const double same_point = kSamePoint * (first.radius + second.radius);
  if (AlongRay(first, second, middle).high > same_point) return true;
  return AnySegment(d, [&](const Vector3d& from, const Vector3d& to) {
    return !ClipToLens(from, to, lens).empty();
  });
}

bool AntipodalTest::operator()(const FaceShape& first, const FaceShape& second) const {
  const Guess guess = ByCenters(first, second);
  if (guess != Guess::kOpen) return guess == Guess::kYes;
  const double farthest = (second.center - first.center).norm() + first.radius + second.radius;
  if (farthest > limits_.max_width) return Width(first, second) <= limits_.max_width;
  return Meet(first, second);
}

double AntipodalTest::Width(const FaceShape& first, const FaceShape& second) const {
  if (-first.normal.dot(second.normal) < cosine_of_double_) return kUnbounded;
  if (!first.has_area() || !second.has_area()) return kUnbounded;
  const double same_point = kSamePoint * (first.radius + second.radius);
  const Lens lens(first, second, limits_.cone_angle);
  double width = kUnbounded;
  AnySegment(DifferencesOf(first, second), [&](const Vector3d& from, const Vector3d& to) {
    const Range range = ClipToLens(from, to, lens);
    if (range.empty()) return false;
    const Vector3d step = to - from;
    const double foot = -from.dot(step) / step.squaredNorm();
    const double at = std::clamp(foot, range.low, range.high);
    width = std::min(width, (from + at * step).norm());
    return false;
  });
  for (const Vector3d& facet : FacetNormals(first, second)) {
    const double length = facet.norm();
    if (length == 0.0) continue;
    for (const double sign : {1.0, -1.0}) {
      const Vector3d u = sign / length * facet;
      const Vector3d direction = NearestInLens(lens, u, limits_.cone_angle);
      if (direction.dot(u) <= 0.0) continue;
      const Range along = AlongRay(first, second, direction);
      if (along.high > same_point) width = std::min(width, std::max(along.low, 0.0));
    }
  }
  return width;
}

}  // namespace antigrasp
