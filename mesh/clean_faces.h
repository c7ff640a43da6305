#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Small repairs of Repair(), each of which tells how many it took away. Faces keep their order.

// Every vertex is replaced by the one that `place` names for it.
void Redirect(const std::vector<std::int32_t>& place, TriangleMesh* mesh);

std::size_t DropUnusedVertices(TriangleMesh* mesh);

// Faces with a repeated vertex are lines: nothing is lost with them, not even closedness.
std::size_t DropLines(TriangleMesh* mesh);

struct DroppedCopies {
  std::size_t duplicates = 0;
  std::size_t cancelled = 0;  // of both windings, where parts lie against each other
};

// Of the faces on the same three vertices the first stays. Where two are wound against each other
// and the surface goes on without them (every edge of such a patch has an even number of other
// faces), as between two bars that share an end, none does: no matter ends there.
DroppedCopies DropCopies(TriangleMesh* mesh);

}  // namespace antigrasp
