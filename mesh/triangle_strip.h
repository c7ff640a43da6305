#pragma once

#include <cstdint>
#include <vector>

#include "antigrasp/mesh/polygon_soup.h"

namespace antigrasp {

// Ends a strip in a list of corners; the next corner begins another one.
inline constexpr std::int64_t kStripRestart = -1;

// The triangles of strips of corners (scans as PLY store them so): every three in a row, every
// second one of a strip turned round, so that all have the winding of the first. Triangles with a
// corner twice, which only carry a strip elsewhere, are left out.
void AppendStrips(const std::vector<std::int64_t>& corners, PolygonSoup* soup);

}  // namespace antigrasp
