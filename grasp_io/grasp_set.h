#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/gripper_base.h"
#include "antigrasp/quality/metric_options.h"

// Grasps of an object on their way into the files of other programs (docs/grasps.md).
namespace antigrasp {

// Where a parallel jaw closes, and what is known of it. Metres, the frame of the mesh times
// metres_per_unit; directions are unit, and the approach is across the axis.
struct PosedGrasp {
  std::string id;
  Eigen::Vector3d center, axis, approach;
  double width = 0.0;  // between the contacts; 0: none are known
  double quality = 0.0;
  std::uint64_t candidate = 0;
  int executions = 0, held = 0;  // in physics
};

struct GraspSet {
  std::string object;            // its name, which is where its mesh lies below some folder
  double metres_per_unit = 1.0;  // of that mesh
  TriangleMesh mesh;             // its own unit; empty where a format needs none (NeedsMesh)
  std::vector<PosedGrasp> grasps;
};

// What a whole file says beside its grasps.
struct GraspFileAbout {
  GripperBase base;
  MetricOptions metric;            // that the grasps were scored by; its gripper is the base's
  double success_quality = 0.002;  // robust quality of a success where nothing was executed
  std::string protocol;            // of the trial; empty: none was made
  double density = 1000.0;         // kg/m3

  // From the base to the grasp's centre, along the approach.
  double Depth() const { return metric.gripper.palm_distance + metric.gripper.palm_depth; }
  // Held in at least half of its executions; of a robust quality of at least success_quality where
  // there are none.
  bool Success(const PosedGrasp& grasp) const;
  std::string LabelText() const;  // that rule, as a file states it
};

}  // namespace antigrasp
