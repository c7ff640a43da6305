#pragma once

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Whether two faces meet anywhere but in the vertices or the edge that they share. Exact predicates
// (CGAL); any mesh with finite vertices and indices in range, manifold or not. Faces without area
// are left out: Inspect() counts those as degenerate.
bool SelfIntersects(const TriangleMesh& mesh);

}  // namespace antigrasp
