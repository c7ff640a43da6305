#pragma once

#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// One side of one triangle, as Inspect() and Repair() see it. Needs indices in range.
struct EdgeUse {
  std::int32_t low, high;  // the end vertices, low <= high
  std::int32_t face;
  bool forward;  // the face runs from low to high
};

// The three sides of every face, sorted so that the uses of one edge are neighbours.
std::vector<EdgeUse> SortedEdgeUses(const TriangleMesh& mesh);

// Calls visit(first, last) with the range of uses of every edge.
template <typename Visit>
void ForEachEdge(const std::vector<EdgeUse>& uses, const Visit& visit) {
  auto first = uses.begin();
  while (first != uses.end()) {
    auto last = first + 1;
    while (last != uses.end() && last->low == first->low && last->high == first->high) ++last;
    visit(first, last);
    first = last;
  }
}

// All that a repair needs to know of most meshes; n log n. Needs indices in range.
struct EdgeCounts {
  int edges = 0;
  int boundary = 0;     // with one face
  int nonmanifold = 0;  // with more than two
  bool Closed() const { return edges > 0 && boundary == 0 && nonmanifold == 0; }
};
EdgeCounts CountEdges(const TriangleMesh& mesh);

// Disjoint sets whose members also carry a parity against the root of their set: two triangles with
// parity 1 between them have to be wound differently from how they are. Near-constant time.
class ParitySets {
 public:
  explicit ParitySets(std::size_t count);

  struct Place {
    std::int32_t root;
    bool odd;
  };
  Place Find(std::int32_t item);

  // Says that a and b differ (odd) or agree. False when that contradicts what was said before.
  bool Join(std::int32_t a, std::int32_t b, bool odd = false);

 private:
  struct Node {
    std::int32_t parent;
    std::int32_t size = 1;
    bool odd = false;
  };
  std::vector<Node> nodes_;
};

// Whether the face has a repeated vertex or no area: its height is below 1e-12 of its longest edge.
bool IsDegenerate(const TriangleMesh& mesh, std::size_t face);

}  // namespace antigrasp
