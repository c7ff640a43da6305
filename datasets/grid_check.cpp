#include "antigrasp/datasets/grid_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "antigrasp/core/statistics.h"

namespace antigrasp {
namespace {

template <typename Use>
void ForEachNode(int n, const Use& use) {
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) use(x, y, z);
    }
  }
}

}  // namespace

double BorderInside(const SdfGrid& grid) {
  std::int64_t nodes = 0, inside = 0;
  ForEachNode(grid.n, [&](int x, int y, int z) {
    const auto [least, most] = std::minmax({x, y, z});
    if (least > 0 && most < grid.n - 1) return;
    ++nodes;
    if (grid.values[grid.Index(x, y, z)] > 0.0F) ++inside;
  });
  return static_cast<double>(inside) / static_cast<double>(nodes);
}

double SlopeAtSurface(const SdfGrid& grid) {
  std::vector<double> slopes;
  ForEachNode(grid.n, [&](int x, int y, int z) {
    const auto [least, most] = std::minmax({x, y, z});
    if (least == 0 || most == grid.n - 1) return;
    const auto at = [&](int dx, int dy, int dz) {
      return static_cast<double>(grid.values[grid.Index(x + dx, y + dy, z + dz)]);
    };
    const bool inside = at(0, 0, 0) > 0.0;
    const std::array<double, 6> around = {at(-1, 0, 0), at(1, 0, 0),  at(0, -1, 0),
                                          at(0, 1, 0),  at(0, 0, -1), at(0, 0, 1)};
    if (std::all_of(around.begin(), around.end(),
                    [&](double value) { return (value > 0.0) == inside; })) {
      return;
    }
    slopes.push_back(
        0.5 * std::hypot(around[1] - around[0], around[3] - around[2], around[5] - around[4]));
  });
  std::erase_if(slopes, [](double slope) { return !std::isfinite(slope); });
  return slopes.empty() ? 0.0 : DiscretePercentile(slopes, 50.0);
}

}  // namespace antigrasp
