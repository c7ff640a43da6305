#pragma once

#include <vector>

#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// How the union of convex parts differs from the solid that it stands for. Lengths in the mesh's
// unit.
struct PartErrors {
  double covered = 0.0;    // volume of the union outside of the solid, as a share of the solid's
  double missing = 0.0;    // volume of the solid outside of the union, likewise
  double hausdorff = 0.0;  // between the two surfaces
  double dent = 0.0;       // how deep the solid's surface lies inside the union at most
};

// Volumes along rays in x, 128 x 128 of them over the box: to about 0.05 % of the volume. Distances
// from points of either surface a quarter of `cell` apart; that from a point in the union to its
// surface is never too small. `solid` closed and outward. 0.1 s for 3,000 faces and 20 parts.
PartErrors MeasureParts(const TriangleMesh& solid, const std::vector<ConvexPart>& parts,
                        double cell);

}  // namespace antigrasp
