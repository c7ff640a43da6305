#pragma once

#include <vector>

#include "antigrasp/mesh/pieces.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// For every piece the number of others that it lies inside of: even = matter, odd = a void. The
// pieces are closed. `group` numbers the pieces that are one body (they cross, and are no place for
// each other). Exact (CGAL), whatever the winding. Free for one piece; else n log n in the faces
// of the pieces whose bounding boxes hold other ones.
std::vector<int> NestingDepths(const TriangleMesh& mesh, const Pieces& pieces,
                               const std::vector<std::int32_t>& group);
std::vector<int> NestingDepths(const TriangleMesh& mesh, const Pieces& pieces);  // none cross

}  // namespace antigrasp
