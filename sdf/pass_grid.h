#pragma once

#include "antigrasp/core/passer.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// A grid for another process (core/passer.h).
inline void PassFields(Passer& pass, SdfGrid& grid) {
  pass(grid.n, grid.spacing, grid.origin, grid.values);
}

}  // namespace antigrasp
