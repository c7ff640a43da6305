#include "antigrasp/sdf/cell_crossing.h"

#include <algorithm>
#include <cstdlib>

namespace antigrasp {
namespace {

IntPoint Minus(const IntPoint& a, const IntPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

IntPoint Cross(const IntPoint& a, const IntPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::int64_t Dot(const IntPoint& a, const IntPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

int Sign(std::int64_t v) { return (v > 0) - (v < 0); }

// Points of one plane, seen along its steepest axis.
struct PlaneView {
  int u, v;
  explicit PlaneView(const IntPoint& normal) : u(1), v(2) {
    int axis = 0;
    for (int a = 1; a < 3; ++a) {
      if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
    }
    u = (axis + 1) % 3;
    v = (axis + 2) % 3;
  }
  int Side(const IntPoint& a, const IntPoint& b, const IntPoint& c) const {
    return Sign((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
  }
  // c, known to be on the line a-b, lies within the segment.
  bool Between(const IntPoint& a, const IntPoint& b, const IntPoint& c) const {
    const auto [u0, u1] = std::minmax(a[u], b[u]);
    const auto [v0, v1] = std::minmax(a[v], b[v]);
    return u0 <= c[u] && c[u] <= u1 && v0 <= c[v] && c[v] <= v1;
  }
  bool Contains(const IntTriangle& t, const IntPoint& p) const {
    const int a = Side(t[0], t[1], p), b = Side(t[1], t[2], p), c = Side(t[2], t[0], p);
    return std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0;
  }
  bool SegmentsMeet(const IntPoint& a, const IntPoint& b, const IntPoint& c,
                    const IntPoint& d) const {
    const int c_side = Side(a, b, c), d_side = Side(a, b, d);
    const int a_side = Side(c, d, a), b_side = Side(c, d, b);
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return (c_side == 0 && Between(a, b, c)) || (d_side == 0 && Between(a, b, d)) ||
           (a_side == 0 && Between(c, d, a)) || (b_side == 0 && Between(c, d, b));
  }
};

bool EdgesTouch(const IntTriangle& s, const IntTriangle& t) {
  for (int i = 0; i < 3; ++i) {
    if (SegmentTouches(s[i], s[(i + 1) % 3], t)) return true;
  }
  return false;
}

// s with the given corner first, order kept.
IntTriangle StartingAt(const IntTriangle& s, int corner) {
  return {s[corner], s[(corner + 1) % 3], s[(corner + 2) % 3]};
}

// The triangles a, b, c and a, b, d lie in one plane on the same side of a-b.
bool Folded(const IntPoint& a, const IntPoint& b, const IntPoint& c, const IntPoint& d) {
  const IntPoint ab = Minus(b, a);
  return Orient(a, b, c, d) == 0 && Dot(Cross(ab, Minus(c, a)), Cross(ab, Minus(d, a))) > 0;
}

}  // namespace

std::int64_t Orient(const IntPoint& a, const IntPoint& b, const IntPoint& c, const IntPoint& d) {
  return Dot(Cross(Minus(b, a), Minus(c, a)), Minus(d, a));
}

bool IsDegenerate(const IntTriangle& t) {
  return Cross(Minus(t[1], t[0]), Minus(t[2], t[0])) == IntPoint{0, 0, 0};
}

bool SegmentTouches(const IntPoint& p, const IntPoint& q, const IntTriangle& t) {
  const int p_side = Sign(Orient(t[0], t[1], t[2], p));
  const int q_side = Sign(Orient(t[0], t[1], t[2], q));
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) {
    const PlaneView view(Cross(Minus(t[1], t[0]), Minus(t[2], t[0])));
    return view.Contains(t, p) || view.Contains(t, q) || view.SegmentsMeet(p, q, t[0], t[1]) ||
           view.SegmentsMeet(p, q, t[1], t[2]) || view.SegmentsMeet(p, q, t[2], t[0]);
  }
  const int a = Sign(Orient(p, q, t[0], t[1]));
  const int b = Sign(Orient(p, q, t[1], t[2]));
  const int c = Sign(Orient(p, q, t[2], t[0]));
  return std::min({a, b, c}) >= 0 || std::max({a, b, c}) <= 0;
}

bool Crosses(const IntTriangle& s, const IntTriangle& t) {
  int shared = 0, s_corner = 0, t_corner = 0;  // the last shared corner
  int s_free = 0, t_free = 0;                  // the last corner that is not shared
  for (int i = 0; i < 3; ++i) {
    const auto it = std::find(t.begin(), t.end(), s[i]);
    if (it == t.end()) {
      s_free = i;
      continue;
    }
    ++shared;
    s_corner = i;
    t_corner = static_cast<int>(it - t.begin());
  }
  if (shared == 0) return EdgesTouch(s, t) || EdgesTouch(t, s);
  if (shared == 1) {  // any common ray leaves through the edge opposite to the shared corner
    const IntTriangle a = StartingAt(s, s_corner), b = StartingAt(t, t_corner);
    return SegmentTouches(a[1], a[2], b) || SegmentTouches(b[1], b[2], a);
  }
  if (shared == 2) {
    for (int i = 0; i < 3; ++i) {
      if (std::find(s.begin(), s.end(), t[i]) == s.end()) t_free = i;
    }
    return Folded(s[(s_free + 1) % 3], s[(s_free + 2) % 3], s[s_free], t[t_free]);
  }
  return true;
}

}  // namespace antigrasp
