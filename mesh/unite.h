#pragma once

#include <cstddef>

#include "antigrasp/mesh/orient.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Puts the union of every group of pieces that meet in the place of its first piece. Returns how
// many pieces were united. None, and the mesh as it was, when one of them crosses itself, when they
// are wound against each other (is it matter or a hole?), and when what comes of it is no closed
// mesh or crosses itself: Inspect() names them. The mesh is closed and `orientation` is that of it.
std::size_t UniteGroups(const Orientation& orientation, TriangleMesh* mesh);

}  // namespace antigrasp
