#pragma once

#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/bundle/solid_test.h"
#include "antigrasp/bundle/surface_points.h"

namespace antigrasp {

// Joins two parts into their hull as long as it covers no deeper dent of the surface than `dent`,
// and then, while there are more than `most`, those that cover the shallowest.
std::vector<ConvexPart> JoinParts(std::vector<ConvexPart> parts, const SurfacePoints& surface,
                                  const SolidTest& solid, double dent, int most);

}  // namespace antigrasp
