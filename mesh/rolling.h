#pragma once

#include <vector>

#include "antigrasp/mesh/hull_facets.h"

namespace antigrasp {

// For every facet the one that the object rests on after landing on it: see StablePoses(). Needs
// the centre of mass inside the hull. O(log n) a step from corner to corner where the hull is
// round; of a rippled ball of 6,000 faces a facet takes one step on average, of 100,000 six, of
// 1,000,000 thirty: the way down is as long as before and the edges are shorter.
std::vector<std::size_t> RestingFacets(const FacetedHull& hull);

}  // namespace antigrasp
