#pragma once

#include <Eigen/Core>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A parallel projection: which way the camera looks and what is in the middle of its picture.
struct Camera {
  Eigen::Vector3d forward, right, up;                // unit, orthogonal
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // in the middle of the picture
  double half_side = 1.0;                            // of the square picture, in the mesh's unit

  // The place of a point in the picture: (0, 0) the top left corner, (1, 1) the bottom right.
  Eigen::Vector2d Project(const Eigen::Vector3d& point) const;
};

// Looks at the middle of the mesh's bounding box from this azimuth about z (from x) and elevation
// above the xy plane, degrees. The ball around that middle that holds the mesh fills the picture to
// 1 / 1.04, from everywhere. half_side is 1 for a mesh without extent.
Camera CameraFor(const TriangleMesh& mesh, double azimuth, double elevation);

}  // namespace antigrasp
