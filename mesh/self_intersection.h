#pragma once

#include <cstdint>
#include <set>
#include <utility>

#include "antigrasp/mesh/pieces.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Whether two faces meet anywhere but in the vertices or the edge that they share. Exact: boxes,
// then PlainStars() and FacesIntersect(); any mesh with finite vertices and indices in range,
// manifold or not. Faces without area are left out: Inspect() counts those as degenerate.
bool SelfIntersects(const TriangleMesh& mesh);

// The same for all of the mesh: which pieces meet, the lower number first; a piece that meets
// itself is a pair of its own.
std::set<std::pair<std::int32_t, std::int32_t>> MeetingPieces(const TriangleMesh& mesh,
                                                              const Pieces& pieces);

}  // namespace antigrasp
