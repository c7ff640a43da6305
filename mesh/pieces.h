#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "antigrasp/mesh/topology.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// The pieces of a mesh: faces that hang together by edges.
struct Pieces {
  std::vector<std::int32_t> of_face;  // numbered from 0 in the order of their first faces
  std::int32_t count = 0;
};

// The sets of faces as pieces.
Pieces PiecesOf(ParitySets* sets, std::size_t faces);

// Every piece as a mesh of its own, vertices in the order of their first use.
std::vector<TriangleMesh> Apart(const TriangleMesh& mesh, const Pieces& pieces);

// Six times the signed volume of every piece, about the middle of the whole; for closed pieces.
std::vector<double> SixVolumes(const TriangleMesh& mesh, const Pieces& pieces);

// Adds `part` behind the vertices and faces of `mesh`; nothing is merged.
void Append(const TriangleMesh& part, TriangleMesh* mesh);

// Turns every face.
void TurnOver(TriangleMesh* mesh);

}  // namespace antigrasp
