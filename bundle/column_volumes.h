#pragma once

#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Volumes of a solid and of the union of convex parts, in the mesh's unit.
struct ColumnVolumes {
  double solid = 0.0;
  double covered = 0.0;  // in the union, not in the solid
  double missing = 0.0;  // in the solid, not in the union
};

// Measured along lines in x through the middles of the cells of a grid over y and z: exact along
// the lines.
ColumnVolumes CompareVolumes(const TriangleMesh& solid, const std::vector<ConvexPart>& parts);

}  // namespace antigrasp
