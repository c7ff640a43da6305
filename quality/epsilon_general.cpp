#include "antigrasp/quality/epsilon_general.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace antigrasp {
namespace {

// Directions that come this near to a half plane are taken as filling it: epsilon is then below
// 1e-10 for any sensible constants, and the sign of the rest is rounding.
constexpr double kUnbounded = 1e-12;

bool SameSide(double x, double y) { return (x >= 0.0) == (y >= 0.0); }

// The point between p and q where a functional with the values fp, fq of opposite sign vanishes.
DualPoint Between(const DualPoint& p, double fp, const DualPoint& q, double fq) {
  const double sum = std::abs(fp) + std::abs(fq);
  const double wp = std::abs(fq) / sum;
  const double wq = std::abs(fp) / sum;
  DualPoint r;
  r.y = wp * p.y + wq * q.y;
  r.g = 0.0;
  r.h = wp * p.h + wq * q.h;
  r.offset = wp * p.offset + wq * q.offset;
  r.t = wp * p.t + wq * q.t;
  return r;
}

// Q recedes to infinity exactly when a non-negative combination of edge directions has g = h = 0,
// that is, unless all their (g, h) lie in one open half plane.
bool Bounded(const WrenchDual& dual) {
  const DualPoint& first = dual.edges[0][0];
  double low = 0.0, high = 0.0;
  for (const auto& edges : dual.edges) {
    for (const DualPoint& edge : edges) {
      if (std::hypot(edge.g, edge.h) < kUnbounded) return false;
      const double angle =
          std::atan2(first.g * edge.h - first.h * edge.g, first.g * edge.g + first.h * edge.h);
      low = std::min(low, angle);
      high = std::max(high, angle);
    }
  }
  return high - low < std::numbers::pi - kUnbounded;
}

class FaceCutter {
 public:
  explicit FaceCutter(const WrenchDual& dual) : dual_(dual), cuts_(dual.Cuts()) {}

  // 2-face: a vertex of C if g changes sign on it.
  void CutPair(const DualPoint& p, const DualPoint& q) {
    if (SameSide(p.g, q.g)) return;
    const DualPoint v = Between(p, p.g, q, q.g);
    if (!(v.t > 0.0)) return;
    Keep(dual_.Norm2Over(v.y.squaredNorm() / (v.t * v.t), v.h / v.t, v.offset / v.t));
  }

  // 3-face: an edge of C if g changes sign on it; Q has vertices where it crosses the cuts.
  void CutTriple(const DualPoint& p, const DualPoint& q, const DualPoint& r) {
    if (SameSide(p.g, q.g)) {
      if (!SameSide(p.g, r.g)) CutEdge(Between(p, p.g, r, r.g), Between(q, q.g, r, r.g));
    } else if (SameSide(p.g, r.g)) {
      CutEdge(Between(p, p.g, q, q.g), Between(r, r.g, q, q.g));
    } else {
      CutEdge(Between(q, q.g, p, p.g), Between(r, r.g, p, p.g));
    }
  }

  double best() const { return best_; }

 private:
  void CutEdge(const DualPoint& p, const DualPoint& q) {
    for (const WrenchDual::Cut& cut : cuts_) {
      const double fp = p.h - cut.h * p.t;
      const double fq = q.h - cut.h * q.t;
      if (SameSide(fp, fq)) continue;
      const DualPoint v = Between(p, fp, q, fq);
      if (!(v.t > 0.0)) continue;
      const double along_kernel = cut.u - v.offset / v.t;
      Keep(v.y.squaredNorm() / (v.t * v.t) + along_kernel * along_kernel * dual_.kernel2);
    }
  }

  void Keep(double norm2) { best_ = std::max(best_, norm2); }

  const WrenchDual& dual_;
  const std::array<WrenchDual::Cut, 4> cuts_;
  double best_ = 0.0;
};

}  // namespace

std::optional<double> MaxNorm2General(const WrenchDual& dual) {
  if (!Bounded(dual)) return std::nullopt;
  FaceCutter cutter(dual);
  for (const auto& edges : dual.edges) {
    for (std::size_t j = 0; j < edges.size(); ++j) {
      cutter.CutPair(dual.apex, edges[j]);
      cutter.CutTriple(dual.apex, edges[j], edges[j + 1 < edges.size() ? j + 1 : 0]);
    }
  }
  for (const DualPoint& first : dual.edges[0]) {
    for (const DualPoint& second : dual.edges[1]) cutter.CutTriple(dual.apex, first, second);
  }
  return cutter.best();
}

}  // namespace antigrasp
