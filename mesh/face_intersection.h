#pragma once

#include <cstdint>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Whether two different faces meet anywhere but in the corners or the edge that they share: what
// SelfIntersects() asks of every pair, exact. A face without area meets nothing. Nearly all
// neighbours are decided in double, by a plane that separates them or by a line where they lie in
// one plane (20 ns), the others by CGAL's exact predicates (0.2 to 5 us).
bool FacesIntersect(const TriangleMesh& mesh, std::int32_t first, std::int32_t second);

}  // namespace antigrasp
