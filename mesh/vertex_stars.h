#pragma once

#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// For every vertex whether its faces certainly meet nowhere but in it and in the edges that they
// share, because they are one closed fan and a direction sees all of them from the front, once
// around: 1 for most vertices of a surface. Double arithmetic with a bound on its error; 0 where
// that leaves it open. Indices in range, vertices finite; 0.1 us a face.
std::vector<char> PlainStars(const TriangleMesh& mesh);

}  // namespace antigrasp
