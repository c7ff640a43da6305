#pragma once

#include <cstdint>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Whether two different faces, neither without area, meet anywhere but in the corners or the edge
// that they share: the same decision as SelfIntersects() of the whole mesh, exact. Nine of ten
// pairs of neighbours are decided in double by a plane that separates them (20 ns), the others by
// CGAL's exact predicates (0.2 us).
bool FacesIntersect(const TriangleMesh& mesh, std::int32_t first, std::int32_t second);

}  // namespace antigrasp
