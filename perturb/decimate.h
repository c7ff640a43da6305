#pragma once

#include <string>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

struct DecimateResult {
  TriangleMesh mesh;    // in single precision
  std::string failure;  // why there is no printable result, in plain words; "" = there is one
};

// Edge collapses until there are fewer than `faces` faces: Lindstrom and Turk (1998), which keeps
// the volume, without collapses that turn a face by 90 degrees or more; where that meets itself,
// once more by Garland and Heckbert (1997). A mesh that is small enough is only rounded. 25-130 ms
// for 2,500-5,500 faces down to 350. The mesh must be a solid.
DecimateResult Decimate(const TriangleMesh& mesh, int faces);

}  // namespace antigrasp
