#pragma once

#include <optional>
#include <vector>

#include "antigrasp/quality/reachability.h"

namespace antigrasp {

inline constexpr double kGripperOpening = 0.05;

TriangleMesh Moved(const TriangleMesh& mesh, double x, double y, double z);

// A mesh with all that is asked of it.
struct ReachedObject {
  TriangleMesh mesh;
  RayScene scene;
  GripperCollision collision;
  explicit ReachedObject(TriangleMesh m, const GripperModel& model = {})
      : mesh(std::move(m)), scene(mesh), collision(mesh, scene, model) {}

  std::optional<Eigen::Vector3d> FreeApproach(const Grasp& grasp) const {
    return collision.FreeApproach(grasp, kGripperOpening);
  }
  bool IsFree(const Grasp& grasp, const Eigen::Vector3d& approach) const {
    return collision.IsFree(grasp, kGripperOpening, approach.normalized());
  }
};

// The antipodal grasps among so many candidates.
std::vector<Grasp> SampledGrasps(const ReachedObject& object, int attempts);

}  // namespace antigrasp
