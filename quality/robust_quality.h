#pragma once

#include <Eigen/Geometry>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/ray_scene.h"
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

// Where the jaws really are, in the moved object's own frame.
struct JawPose {
  Eigen::Vector3d center;
  Eigen::Vector3d axis;  // unit
};
JawPose ExecutedPose(const Grasp& grasp, const Eigen::Vector3d& com, const NoiseDraw& noise);

// Epsilon of the grasp as executed under one draw: the object (its centre of mass with it) and the
// gripper are displaced, the jaws close anew. 0 when a jaw misses, starts inside or slips.
// Everything is computed in the moved object's own frame, by moving the gripper the other way: the
// friction pyramid's first edge follows the object's +x axis wherever the object is, so that only
// the pose of the gripper relative to the object matters.
double ExecutedQuality(const RayScene& scene, const Eigen::Vector3d& com, const Grasp& grasp,
                       const MetricOptions& options, const NoiseDraw& noise);

// Mean of ExecutedQuality over options.num_draws draws.
double RobustQuality(const RayScene& scene, const Eigen::Vector3d& com, const Grasp& grasp,
                     const MetricOptions& options, RngStream* rng);

}  // namespace antigrasp
