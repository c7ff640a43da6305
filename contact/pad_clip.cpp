#include "antigrasp/contact/pad_clip.h"

#include <algorithm>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Metres: a corner this near to the rim is on it.
constexpr double kOnRim = 1e-9;

// Metres: two corners of a face whose distances from the front face differ by less are level.
constexpr double kLevel = 1e-9;

// Metres: what lies deeper behind the front face, but is nearer to a side, came in from there. No
// load and no step of a closing jaw takes the front that deep.
constexpr double kFromTheSide = 0.25e-3;

// Of a face's normal: less than this towards the pad is along it.
constexpr double kLooksAtPad = 1e-9;

// A triangle cut by six planes has at most nine corners, rounding aside.
struct Polygon {
  std::array<Vector3d, 16> corner;
  std::size_t size = 0;
  void Add(const Vector3d& point) {
    if (size < corner.size()) corner[size++] = point;
  }
};

// From the lexicographically first end: the same bits from both faces of an edge.
Vector3d Cut(Vector3d a, Vector3d b, int axis, double at) {
  if (std::lexicographical_compare(b.begin(), b.end(), a.begin(), a.end())) std::swap(a, b);
  Vector3d cut = a + (at - a[axis]) / (b[axis] - a[axis]) * (b - a);
  cut[axis] = at;
  return cut;
}

// Keeps what has sign * coordinate <= sign * at (Sutherland and Hodgman).
void Clip(const Polygon& polygon, int axis, double sign, double at, Polygon* kept) {
  kept->size = 0;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Vector3d& from = polygon.corner[i];
    const Vector3d& to = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    const bool from_in = sign * from[axis] <= sign * at;
    const bool to_in = sign * to[axis] <= sign * at;
    if (from_in) kept->Add(from);
    if (from_in != to_in) kept->Add(Cut(from, to, axis, at));
  }
}

// -1, 0 or 1: at which rim of [-half, half].
double Rim(double value, double half) {
  if (value >= half - kOnRim) return 1.0;
  return value <= kOnRim - half ? -1.0 : 0.0;
}

// The side of the pad (axis 1 or 2, -1 or 1) that what is cut out of a face is pushed out of by the
// shortest way; axis 0: the front.
struct WayOut {
  int axis = 0;
  double sign = 1.0, depth = 0.0;
};

WayOut ShortestWayOut(const Polygon& polygon, const Vector3d& half) {
  WayOut way;
  const Vector3d* const begin = polygon.corner.data();
  const auto deepest = [&](int axis, double sign, double rim) {
    double depth = 0.0;
    for (const Vector3d* q = begin; q != begin + polygon.size; ++q) {
      depth = std::max(depth, rim - sign * (*q)[axis]);
    }
    return depth;
  };
  way.depth = deepest(0, 1.0, 0.0);
  if (way.depth < kFromTheSide) return way;
  for (int axis = 1; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double depth = deepest(axis, sign, half[axis]);
      if (depth < way.depth) way = {axis, sign, depth};
    }
  }
  return way;
}

}  // namespace

void AddPadContacts(const PadPose& pad, double margin, const std::array<Vector3d, 3>& corners,
                    const Vector3d& normal, bool sides, std::vector<PatchPoint>* points) {
  const Vector3d front = pad.Front();
  const Vector3d low(-2.0 * pad.half[0], -pad.half[1], -pad.half[2]);
  const Vector3d high(margin, pad.half[1], pad.half[2]);
  const Vector3d into = -(pad.axes.transpose() * normal);  // the object, pad's frame
  if (into[0] <= kLooksAtPad) return;
  const std::array<Vector3d, 3> p{pad.axes.transpose() * (corners[0] - front),
                                  pad.axes.transpose() * (corners[1] - front),
                                  pad.axes.transpose() * (corners[2] - front)};
  const Vector3d least = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
  const Vector3d most = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  if ((least.array() > high.array()).any() || (most.array() < low.array()).any()) return;
  std::array<Polygon, 2> buffers;
  std::size_t used = 0;
  for (const Vector3d& corner : p) buffers[used].Add(corner);
  const auto clip = [&](int axis, double sign, double at) {
    Clip(buffers[used], axis, sign, at, &buffers[1 - used]);
    used = 1 - used;
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (most[axis] > high[axis]) clip(axis, 1.0, high[axis]);
    if (least[axis] < low[axis]) clip(axis, -1.0, low[axis]);
  }
  const Polygon& polygon = buffers[used];
  if (const WayOut way = sides ? ShortestWayOut(polygon, pad.half) : WayOut(); way.axis > 0) {
    for (std::size_t i = 0; i < polygon.size; ++i) {
      const Vector3d& q = polygon.corner[i];
      const double depth = pad.half[way.axis] - way.sign * q[way.axis];
      if (q[0] >= 0.0 || depth <= kOnRim) continue;
      Eigen::Vector2d place = q.tail<2>();
      place[way.axis - 1] = way.sign * pad.half[way.axis];
      // Between the front face and what is seen of the wall that came in.
      points->push_back({place, way.sign * Vector3d::Unit(way.axis), -depth, true, 0.5 * q[0]});
    }
    return;
  }
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Vector3d& q = polygon.corner[i];
    const Vector3d& before = polygon.corner[i > 0 ? i - 1 : polygon.size - 1];
    const Vector3d& after = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
    Vector3d reach = into;  // as far as the normals of the rim go
    for (int k = 1; k < 3; ++k) {
      if (Rim(q[k], pad.half[k]) * into[k] <= 0.0) reach[k] = 0.0;
    }
    if (reach[1] == 0.0 && reach[2] == 0.0) {
      reach[0] = 1.0;
    } else {
      reach.normalize();
    }
    const bool lowest = std::min(before[0], after[0]) >= q[0] - kLevel;
    points->push_back({q.tail<2>(), reach, q[0] * reach[0], lowest});
  }
}

SurfaceContact PadContact(const PadPose& pad, const PatchPoint& point) {
  const Vector3d on_tip(point.x, point.place[0], point.place[1]);
  return {pad.Front() + pad.axes * (on_tip + 0.5 * point.distance * point.normal),
          -(pad.axes * point.normal), point.distance};
}

}  // namespace antigrasp
