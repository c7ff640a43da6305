#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "antigrasp/mesh/pieces.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What OrientFaces() found and did.
struct Orientation {
  std::size_t turned = 0;            // faces
  Pieces pieces;                     // connected by edges of two faces
  std::vector<std::int32_t> group;   // of every piece: pieces that meet are one group
  std::vector<bool> crosses_itself;  // every piece
  std::vector<bool> inward;          // every piece, as its file wound it
};

// Makes neighbours agree. Then every piece of a closed mesh faces outward, or inward where it lies
// inside an odd number of others: it is a void. An open piece has no outside: the majority of its
// faces is right. Pieces that meet are found by a test of all faces where there are several.
Orientation OrientFaces(TriangleMesh* mesh, bool closed);

}  // namespace antigrasp
