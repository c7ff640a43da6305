#include "antigrasp/contact/contact_patch.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>

namespace antigrasp {
namespace {

using Eigen::Vector2d;
using Patch = std::vector<PatchPoint>;

// Metres.
constexpr double kAsDeep = 1e-9;    // as another one but for rounding
constexpr double kYields = 20e-6;   // a soft contact, under the load of a grip
constexpr double kStraight = 1e-6;  // a corner that stands out by less is none
constexpr double kSamePlace = 20e-6;
constexpr double kAnyDepth = std::numeric_limits<double>::infinity();

// Total, so that the order in which faces were found says nothing.
bool Before(const PatchPoint& a, const PatchPoint& b) {
  const auto key = [](const PatchPoint& p) {
    return std::tie(p.place.x(), p.place.y(), p.distance, p.normal.x(), p.normal.y(), p.normal.z(),
                    p.x);
  };
  return key(a) < key(b);
}

double Turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Counter-clockwise from the first of the sorted points (Andrew's monotone chain).
Patch Hull(const Patch& sorted) {
  Patch hull;
  if (sorted.empty()) return hull;
  const auto add = [&](const PatchPoint& point, std::size_t keep) {
    while (hull.size() > keep &&
           Turn(hull[hull.size() - 2].place, hull.back().place, point.place) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(point);
  };
  for (const PatchPoint& point : sorted) add(point, 1);
  const std::size_t lower = hull.size();
  for (auto point = std::next(sorted.rbegin()); point < sorted.rend(); ++point) add(*point, lower);
  if (hull.size() > 1) hull.pop_back();  // the first one again
  return hull;
}

// How far the point stands out from its neighbours' connection.
double StandsOut(const Patch& polygon, std::size_t i) {
  const std::size_t n = polygon.size();
  const Vector2d& at = polygon[i].place;
  const Vector2d& from = polygon[(i + n - 1) % n].place;
  const Vector2d along = polygon[(i + 1) % n].place - from;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp((at - from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (at - from - share * along).norm();
}

void Thin(std::size_t most, Patch* polygon) {
  while (polygon->size() > 1) {
    std::size_t least = 0;
    double height = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      const double stands_out = StandsOut(*polygon, i);
      if (stands_out < height) std::tie(height, least) = std::tuple(stands_out, i);
    }
    if (polygon->size() <= most && height > kStraight) return;
    polygon->erase(polygon->begin() + static_cast<std::ptrdiff_t>(least));
  }
}

// Copies of a corner from the faces around it: one, the deepest; lowest if it is in all of them.
void JoinCopies(Patch* sorted) {
  Patch joined;
  for (const PatchPoint& point : *sorted) {
    if (joined.empty() || joined.back().place != point.place) {
      joined.push_back(point);
    } else {
      joined.back().lowest &= point.lowest;
    }
  }
  *sorted = std::move(joined);
}

// Whether one of the corners is at the point's place and nearer than this.
bool HasNear(const Patch& corners, const PatchPoint& point, double distance) {
  return std::any_of(corners.begin(), corners.end(), [&](const PatchPoint& corner) {
    return corner.distance < distance && (corner.place - point.place).norm() <= kSamePlace;
  });
}

// Adds the corners of the outline of those points that `count` says yes to, while there is room.
template <typename Count>
void AddOutline(const Patch& sorted, const Count& count, std::size_t most, Patch* corners) {
  if (corners->size() >= most) return;
  Patch counted;
  std::copy_if(sorted.begin(), sorted.end(), std::back_inserter(counted), count);
  Patch hull = Hull(counted);
  Thin(hull.size(), &hull);  // before corners go: what is straight now would stand out then
  Patch outline;
  std::copy_if(hull.begin(), hull.end(), std::back_inserter(outline), [&](const PatchPoint& point) {
    return !HasNear(*corners, point, kAnyDepth) && !HasNear(hull, point, point.distance - kAsDeep);
  });
  Thin(most - corners->size(), &outline);
  corners->insert(corners->end(), outline.begin(), outline.end());
}

}  // namespace

std::vector<PatchPoint> PatchCorners(std::vector<PatchPoint> points, int most, bool all_ends) {
  if (points.empty()) return {};
  std::sort(points.begin(), points.end(), Before);
  JoinCopies(&points);
  double deepest = std::numeric_limits<double>::infinity();
  for (const PatchPoint& point : points) deepest = std::min(deepest, point.distance);
  const auto within = [&](double slack) {
    return [=](const PatchPoint& point) { return point.distance <= deepest + slack; };
  };
  const auto bears = [&](const PatchPoint& point) {
    return point.lowest && within(kYields)(point);
  };
  const auto room = static_cast<std::size_t>(most);
  Patch corners;
  AddOutline(points, within(kAsDeep), room, &corners);
  AddOutline(points, bears, room, &corners);
  const auto overlaps = [](const PatchPoint& point) { return point.distance < 0.0; };
  // Where all of them are lowest ones, the next outline has them.
  if (all_ends && std::any_of(points.begin(), points.end(), [&](const PatchPoint& point) {
        return overlaps(point) && !point.lowest;
      })) {
    AddOutline(points, overlaps, room, &corners);
  }
  AddOutline(
      points, [](const PatchPoint& point) { return point.lowest; }, room, &corners);
  AddOutline(
      points, [](const PatchPoint&) { return true; }, room, &corners);
  return corners;
}

}  // namespace antigrasp
