#pragma once

#include <Eigen/Core>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {

// Where a point lies with respect to a closed, outward mesh. A few microseconds a question.
class SolidTest {
 public:
  explicit SolidTest(const TriangleMesh& solid) : rays_(solid), distance_(solid) {}
  double Distance(const Eigen::Vector3d& point) const { return distance_.Unsigned(point); }
  bool Inside(const Eigen::Vector3d& point) const;
  // Whether it lies outside and further than `distance` from the surface.
  bool InAir(const Eigen::Vector3d& point, double distance) const {
    return !Inside(point) && distance_.Unsigned(point) > distance;
  }

 private:
  RayScene rays_;
  MeshDistance distance_;
};

}  // namespace antigrasp
