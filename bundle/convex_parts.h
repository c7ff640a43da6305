#pragma once

#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

struct PartOptions {
  int parts = 32;     // at most
  double dent = 0.4;  // cells: no single part covers a deeper one, where `parts` suffice
  // How far facets over air are drawn in (draw_in.h); 0: the parts hold all of the solid.
  double draw_in = 0.3;
};

// A cell of the grid of 32^3 nodes on which the object would be imported (sdf_grid.h): a 28th of
// the largest extent, in the mesh's unit.
double CellOf(const TriangleMesh& solid);

// Convex parts that together stand for a solid (a closed, outward mesh) and keep its dents. The
// solid is cut by planes through the deepest dents that hulls of its pieces cover, the cut that
// leaves the least volume of hulls each time; then hulls whose union is nearly convex are joined.
// Where `parts` do not suffice the shallowest dents are covered. At last facets over air are drawn
// in. Deterministic; one thread. The largest part first.
std::vector<ConvexPart> ConvexParts(const TriangleMesh& solid, const PartOptions& options);

}  // namespace antigrasp
