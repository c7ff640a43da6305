#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "antigrasp/core/rng.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// One draw of everything that is uncertain when a grasp is executed (paper III-B).
struct NoiseDraw {
  Eigen::Vector3d object_translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d object_rotation = Eigen::Vector3d::Zero();  // rotation vector, about the com
  Eigen::Vector3d grasp_translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d grasp_rotation = Eigen::Vector3d::Zero();  // rotation vector, about the centre
  double friction = 0.5;
};

// Thirteen normal numbers in this order, whatever the standard deviations are, so that draws pair
// up between objects and between noise levels.
NoiseDraw DrawNoise(const MetricOptions& options, RngStream* rng);
// As many calls of it, faster.
void DrawNoises(const MetricOptions& options, RngStream* rng, std::span<NoiseDraw> draws);

// Where the jaws really are, in the moved object's own frame.
struct JawPose {
  Eigen::Vector3d center;
  Eigen::Vector3d axis;  // unit
};
JawPose ExecutedPose(const Grasp& grasp, const Eigen::Vector3d& com, const NoiseDraw& noise);

// The gripper's frame there: the origin midway between the fingertips, x from tip 1 to tip 2, z
// against the way in, which is the planned one made square to the axis: noise about the axis moves
// no fingertip. A grasp without a way in gets one.
Eigen::Isometry3d GripperFrame(const Grasp& grasp, const JawPose& jaws);

}  // namespace antigrasp
