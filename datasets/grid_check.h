#pragma once

#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// Share of the outermost nodes that are inside: about 0 of a grid around a solid, about 1 where
// positive means outside.
double BorderInside(const SdfGrid& grid);

// How steep the values are at the surface, per distance of nodes: the median, over the nodes that
// have a neighbour of the other sign, of the length of the gradient by central differences. The
// spacing of the grid where the values are distances; 0 without a surface.
double SlopeAtSurface(const SdfGrid& grid);

}  // namespace antigrasp
