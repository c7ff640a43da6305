#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// One way for an object to stand on a table.
struct StablePose {
  // Turns the object into the pose. Its rows are the table's axes in the object frame, as in
  // Dex-Net's stable poses: row 2 is the table's normal, up. The turn about the normal is free: row
  // 0 lies in the object's xy plane.
  Eigen::Matrix3d table_from_object = Eigen::Matrix3d::Identity();
  double probability = 0.0;
  double com_height = 0.0;  // of the centre of mass above the table, in the mesh's unit
};

// The quasi-static stable poses of an object that is let down from a random orientation (Goldberg
// et al., "Part pose statistics", 1999; Dex-Net), the likeliest first; probabilities sum to 1. A
// facet of the convex hull is met with its share of the solid angle about the centre of mass. It is
// a stable pose when the centre of mass lies above its inside. Otherwise the object rolls over the
// nearest edge or corner of the facet, always the way its centre of mass sinks fastest, until it
// rests. (Dex-Net rolls over an edge even where a corner is nearest, and counts each triangle of a
// flat facet by itself.) Neighbouring hull triangles within 1e-5 of the object's size of one plane
// are one facet.
//
// Any mesh: only its vertices count. No pose when they lie in one plane or when the centre of mass
// is not inside their hull. With every vertex on the hull 10 ms for 2,500 faces and 0.9 s for
// 100,000, half of it the hull.
std::vector<StablePose> StablePoses(const TriangleMesh& mesh, const Eigen::Vector3d& com);

}  // namespace antigrasp
