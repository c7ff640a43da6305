#pragma once

#include <vector>

#include "antigrasp/mesh/hull_facets.h"

namespace antigrasp {

// RestingFacets() by looking at every corner and every facet each time: O(n) a facet.
std::vector<std::size_t> PlainRestingFacets(const FacetedHull& hull);

}  // namespace antigrasp
