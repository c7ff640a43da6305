#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/stable_poses.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

struct TableOptions {
  double approach_cone = 45.0;  // widest angle between the way in and straight down, degrees
  double clearance = 0.0;       // of the gripper above the table, metres
};

// Whether a gripper gets to a grasp on an object that stands on a table (paper VII-B). The rule:
//   - the way in is at most approach_cone from straight down;
//   - no box of the gripper (two fingers and a palm, opened to metric.jaw_opening) reaches below
//     clearance above the table, at the grasp or on its straight way in;
//   - no box touches the object (GripperCollision).
// metric.gripper.approach_angles ways in are tried, equally spaced about the grasp axis from the
// steepest one. With metric.collision = kJaws there are no boxes: the cone alone counts.
class TableReach {
 public:
  // The mesh and its scene must outlive this. Metres.
  TableReach(const TriangleMesh& mesh, const RayScene& scene, const MetricOptions& metric,
             const TableOptions& table);
  ~TableReach();
  TableReach(TableReach&&) noexcept;
  TableReach& operator=(TableReach&&) noexcept;

  // The steepest way in (unit, object frame, from the palm to the fingertips); nullopt when there
  // is none. Const and thread-safe.
  std::optional<Eigen::Vector3d> Approach(const Grasp& grasp, const StablePose& pose) const;

  // The same question for the grasp's own approach (unit, orthogonal to its axis).
  bool Reaches(const Grasp& grasp, const StablePose& pose) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace antigrasp
