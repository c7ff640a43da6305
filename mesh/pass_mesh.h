#pragma once

#include "antigrasp/core/passer.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A mesh for another process (core/passer.h).
inline void PassFields(Passer& pass, TriangleMesh& mesh) { pass(mesh.vertices, mesh.faces); }
inline void PassFields(Passer& pass, BoundingBox& box) { pass(box.min, box.max); }

}  // namespace antigrasp
