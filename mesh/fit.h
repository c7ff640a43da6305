#pragma once

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// The mesh scaled so that its largest bounding-box extent is `extent` (same unit as the result),
// centred over the origin in x and y and standing on z = 0, as a slicer's plate wants it.
// CHECK: the mesh has a positive extent.
TriangleMesh FitToPlate(const TriangleMesh& mesh, double extent);

}  // namespace antigrasp
