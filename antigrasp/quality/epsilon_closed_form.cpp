#include "antigrasp/quality/epsilon_closed_form.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace antigrasp {
namespace {

constexpr int kMaxEdges = 16;
// Nearer to the pyramid's side than this the polygons grow so long that the quadratic form below
// would lose digits; the general method has no such limit.
constexpr double kInside = 1e-3;

// One polygon of C in arrays, so that the loops over it vectorise.
struct Polygon {
  int size = 0;
  std::array<std::array<double, kMaxEdges>, 6> y;
  std::array<double, kMaxEdges> h, offset, norm2;
};

// Where the ray from the apex along each edge direction meets g = 0.
Polygon CutPolygon(const DualPoint& apex, const std::vector<DualPoint>& edges) {
  Polygon polygon;
  polygon.size = static_cast<int>(edges.size());
  for (std::size_t j = 0; j < edges.size(); ++j) {
    const double reach = apex.g / -edges[j].g;
    double norm2 = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
      const double y = apex.y[static_cast<int>(k)] + reach * edges[j].y[static_cast<int>(k)];
      polygon.y[k][j] = y;
      norm2 += y * y;
    }
    polygon.h[j] = apex.h + reach * edges[j].h;
    polygon.offset[j] = apex.offset + reach * edges[j].offset;
    polygon.norm2[j] = norm2;
  }
  return polygon;
}

// Largest |y|^2 where the edges from vertex i of `from` to every vertex of `to` cross the cut.
double MaxOverCut(const Polygon& from, std::size_t i, const Polygon& to, const WrenchDual::Cut& cut,
                  double kernel2) {
  std::array<double, kMaxEdges> norm2{};
  const double na = from.norm2[i], ha = from.h[i], oa = from.offset[i];
  const auto size = static_cast<std::size_t>(to.size);
  for (std::size_t k = 0; k < size; ++k) {
    double dot = 0.0;
    for (std::size_t d = 0; d < 6; ++d) dot += from.y[d][i] * to.y[d][k];
    const bool crosses = (ha < cut.h) != (to.h[k] < cut.h);
    const double t = (cut.h - ha) / (to.h[k] - ha);
    const double u = cut.u - (oa + t * (to.offset[k] - oa));
    const double value = (1.0 - t) * (1.0 - t) * na + 2.0 * t * (1.0 - t) * dot +
                         t * t * to.norm2[k] + u * u * kernel2;
    norm2[k] = crosses ? value : 0.0;
  }
  return *std::max_element(norm2.begin(), norm2.begin() + to.size);
}

// The same over the polygon's own sides.
double MaxOverSides(const Polygon& polygon, const WrenchDual::Cut& cut, double kernel2) {
  double best = 0.0;
  const auto size = static_cast<std::size_t>(polygon.size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t k = i + 1 < size ? i + 1 : 0;
    if ((polygon.h[i] < cut.h) == (polygon.h[k] < cut.h)) continue;
    const double t = (cut.h - polygon.h[i]) / (polygon.h[k] - polygon.h[i]);
    const double u = cut.u - (polygon.offset[i] + t * (polygon.offset[k] - polygon.offset[i]));
    double value = u * u * kernel2;
    for (std::size_t d = 0; d < 6; ++d) {
      const double y = polygon.y[d][i] + t * (polygon.y[d][k] - polygon.y[d][i]);
      value += y * y;
    }
    best = std::max(best, value);
  }
  return best;
}

}  // namespace

bool InClosedFormDomain(const WrenchDual& dual) {
  if (!(dual.apex.g > 0.0)) return false;
  for (const auto& edges : dual.edges) {
    if (edges.size() > kMaxEdges) return false;
    for (const DualPoint& edge : edges) {
      if (!(edge.g < -kInside)) return false;
    }
  }
  return true;
}

double MaxNorm2ClosedForm(const WrenchDual& dual) {
  const Polygon first = CutPolygon(dual.apex, dual.edges[0]);
  const Polygon second = CutPolygon(dual.apex, dual.edges[1]);
  double best = 0.0;
  double low = first.h[0], high = first.h[0];
  for (const Polygon* polygon : {&first, &second}) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(polygon->size); ++j) {
      best = std::max(best, dual.Norm2Over(polygon->norm2[j], polygon->h[j], polygon->offset[j]));
      low = std::min(low, polygon->h[j]);
      high = std::max(high, polygon->h[j]);
    }
  }
  for (const WrenchDual::Cut& cut : dual.Cuts()) {
    if (cut.h < low || cut.h > high) continue;  // the usual case: torsion binds on one contact only
    for (std::size_t j = 0; j < static_cast<std::size_t>(first.size); ++j) {
      best = std::max(best, MaxOverCut(first, j, second, cut, dual.kernel2));
    }
    best = std::max(best, MaxOverSides(first, cut, dual.kernel2));
    best = std::max(best, MaxOverSides(second, cut, dual.kernel2));
  }
  return best;
}

}  // namespace antigrasp
