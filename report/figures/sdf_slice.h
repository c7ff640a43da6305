#pragma once

#include <array>
#include <vector>

#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// A cross-section of a grid of signed distances, n x n values; (u, v) are the two other axes in
// their order: y z for x, x z for y, x y for z.
struct SdfSlice {
  int n = 0;
  std::vector<float> values;  // u fastest
  float At(int u, int v) const { return values[static_cast<std::size_t>(v * n + u)]; }
};

// Across `axis` (0, 1, 2) at `position` in the grid's frame, linear between the two layers of nodes
// beside it; cut to the grid. NaN where a value is none.
SdfSlice MakeSlice(const SdfGrid& grid, int axis, double position);

// Where the slice, linear along the sides of its cells, is zero: pieces of line in node coordinates
// (u, v), one or two a cell (marching squares; a saddle joins what its mean says). Cells with a
// value that is none have no pieces.
using ContourPiece = std::array<std::array<double, 2>, 2>;
std::vector<ContourPiece> ZeroContour(const SdfSlice& slice);

}  // namespace antigrasp
