#pragma once

#include <optional>

#include "antigrasp/quality/wrench_dual.h"

namespace antigrasp {

// max |y|^2 over Q for any directions of the contacts and any number of cone edges; nullopt when Q
// is unbounded (the origin is not inside the wrench hull). 5-10 us at 8 edges.
//
// The product of the two cones with the homogeneous coordinate t is (ray) x (cone) x (cone), so its
// faces are known without a search: C's vertices lie on its 2-faces, C's edges on its 3-faces.
// Every new point is a positive combination of two old ones of opposite sign (nothing cancels), and
// a value of exactly 0 counts as positive everywhere, which is a consistent perturbation: flat,
// coplanar and symmetric cases need no tolerance.
std::optional<double> MaxNorm2General(const WrenchDual& dual);

}  // namespace antigrasp
