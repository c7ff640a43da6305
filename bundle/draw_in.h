#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/bundle/solid_test.h"

namespace antigrasp {

// Draws the facets that cover air in by `share` of how far the solid is below them at most (no more
// than a cell counts): the union is then a little inside of the solid at its ridges, and so much
// less outside over its dents. Facets on the solid, and in it, stay. By less, or not at all, where
// a corner of the part would come to lie more than 0.4 cells outside of all parts; a part of which
// nothing is left then, a sliver over air, goes.
std::vector<ConvexPart> DrawnIn(std::vector<ConvexPart> parts, const SolidTest& solid, double share,
                                double cell);

// What is behind all planes; `inside` is a point that is. Empty when it has no volume.
ConvexPart Behind(const std::vector<HalfSpace>& planes, const Eigen::Vector3d& inside);

}  // namespace antigrasp
