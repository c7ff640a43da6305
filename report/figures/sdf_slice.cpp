#include "antigrasp/report/figures/sdf_slice.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/core/check.h"

namespace antigrasp {

SdfSlice MakeSlice(const SdfGrid& grid, int axis, double position) {
  AG_CHECK(axis >= 0 && axis < 3 && grid.n > 1, "an axis of a grid");
  const double at = std::clamp((position - grid.origin[axis]) / grid.spacing, 0.0, grid.n - 1.0);
  const int below = std::min(static_cast<int>(at), grid.n - 2);
  const auto share = static_cast<float>(at - below);
  SdfSlice slice;
  slice.n = grid.n;
  slice.values.reserve(static_cast<std::size_t>(grid.n * grid.n));
  const auto value = [&](int layer, int u, int v) {
    const std::array<int, 3> node = axis == 0   ? std::array{layer, u, v}
                                    : axis == 1 ? std::array{u, layer, v}
                                                : std::array{u, v, layer};
    return grid.values[grid.Index(node[0], node[1], node[2])];
  };
  for (int v = 0; v < grid.n; ++v) {
    for (int u = 0; u < grid.n; ++u) {
      const float low = value(below, u, v), high = value(below + 1, u, v);
      slice.values.push_back(low + share * (high - low));
    }
  }
  return slice;
}

std::vector<ContourPiece> ZeroContour(const SdfSlice& slice) {
  std::vector<ContourPiece> pieces;
  for (int v = 0; v + 1 < slice.n; ++v) {
    for (int u = 0; u + 1 < slice.n; ++u) {
      // Corners counter-clockwise; side k runs from corner k to k + 1.
      const std::array<std::array<int, 2>, 4> corner = {
          {{u, v}, {u + 1, v}, {u + 1, v + 1}, {u, v + 1}}};
      std::array<double, 4> value;
      for (std::size_t k = 0; k < 4; ++k) value[k] = slice.At(corner[k][0], corner[k][1]);
      if (!std::all_of(value.begin(), value.end(), [](double d) { return std::isfinite(d); })) {
        continue;
      }
      std::vector<std::array<double, 2>> crossings;  // in the order of the sides
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        if ((value[k] > 0.0) == (value[next] > 0.0)) continue;
        const double share = value[k] / (value[k] - value[next]);
        crossings.push_back({corner[k][0] + share * (corner[next][0] - corner[k][0]),
                             corner[k][1] + share * (corner[next][1] - corner[k][1])});
      }
      if (crossings.size() == 2) pieces.push_back({crossings[0], crossings[1]});
      if (crossings.size() != 4) continue;
      const double mean = 0.25 * (value[0] + value[1] + value[2] + value[3]);
      // The middle belongs with corners 0 and 2: the lines cut off corners 1 and 3, or vice versa.
      const bool with_first = (mean > 0.0) == (value[0] > 0.0);
      pieces.push_back({crossings[0], crossings[with_first ? 1 : 3]});
      pieces.push_back({crossings[2], crossings[with_first ? 3 : 1]});
    }
  }
  return pieces;
}

}  // namespace antigrasp
