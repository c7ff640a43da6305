#pragma once

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A closed outward mesh of 4 rings (rings - 1) faces along circles of latitude and longitude of a
// sphere whose radius goes up and down by 1 % at most: it stays convex, so that every vertex is a
// corner of its hull, and no two facets are alike. About 0.1 across.
TriangleMesh RippledSolid(int rings);

}  // namespace antigrasp
