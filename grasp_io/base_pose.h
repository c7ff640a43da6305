#pragma once

#include <Eigen/Core>

#include "antigrasp/grasp_io/grasp_set.h"
#include "antigrasp/quality/given_grasps.h"

namespace antigrasp {

// How a base lies behind its grasp: which of its axes points along the approach, which from jaw 1
// to jaw 2, and how far the grasp's centre is along the approach, m.
struct BaseFrame {
  LinkAxis approach = LinkAxis::kZ, closing = LinkAxis::kX;
  double depth = 0.0;
};

// Of the link that a robot description names.
BaseFrame LinkFrame(const GripperBase& base, const MetricOptions& metric);
// The convention of ACRONYM and GraspGen: z the approach, x the closing direction.
BaseFrame ConventionFrame(const MetricOptions& metric);

// object_from_base, metres. Rows first in files.
Eigen::Matrix4d BasePose(const PosedGrasp& grasp, const BaseFrame& frame);

// The other way round, in metres of the rescaled object. NaN, which scores as "no pose", for a
// matrix that turns by no rotation (to 1e-3: files of single precision) or holds no numbers.
void TakeBasePose(const Eigen::Matrix4d& object_from_base, const BaseFrame& frame,
                  GivenGrasp* grasp);

// A quaternion of any length but 0; NaN for that.
Eigen::Matrix4d PoseOf(const Eigen::Vector3d& position, double w, const Eigen::Vector3d& xyz);

// InputError unless a file's name of its gripper is the base's, or none that is known as another
// gripper's: its poses would be those of another depth.
void RequireSameGripper(const std::string& name, const GripperBase& base, const std::string& path);

}  // namespace antigrasp
