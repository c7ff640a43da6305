#pragma once

#include <cstddef>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Flips the long edges of faces without area (IsDegenerate) in a closed mesh, however it is wound:
// the surface stays, and the mesh closed. Returns how many; where nothing but a hole could come of
// it a sliver stays. Faces keep their number. Linear in the faces where none is a sliver,
// else n log n for every link of the longest chain of slivers.
std::size_t FlipSlivers(TriangleMesh* mesh);

}  // namespace antigrasp
