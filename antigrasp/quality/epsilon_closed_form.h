#pragma once

#include "antigrasp/quality/wrench_dual.h"

namespace antigrasp {

// True when each contact lies well inside the other's friction pyramid. Then C is the join of two
// polygons: its vertices are theirs, its edges are theirs and one from each vertex to each.
bool InClosedFormDomain(const WrenchDual& dual);

// max |y|^2 over Q there. About 1 us, no heap.
double MaxNorm2ClosedForm(const WrenchDual& dual);

}  // namespace antigrasp
