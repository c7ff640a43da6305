#pragma once

#include <memory>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// Exact signed distances to a closed, outward mesh, positive inside: an own bounding-volume
// hierarchy, the previous node's hit as first bound, sign by crossing parity along rows of x.
// Fills the given grid's values. CHECKs that the mesh is closed. 15-60 ms for 2,500 faces on 32^3,
// one thread; longest for balls and rings, whose middle is equally far from everything.
void MeshToSdf(const TriangleMesh& mesh, SdfGrid* grid);

// Distance queries against a fixed mesh (also used by tests and measures of change).
class MeshDistance {
 public:
  explicit MeshDistance(const TriangleMesh& mesh);
  ~MeshDistance();
  double Unsigned(const Eigen::Vector3d& point) const;  // exact Euclidean distance to the surface

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace antigrasp
