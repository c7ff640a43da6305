#pragma once

#include <Eigen/Core>
#include <span>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/execution_noise.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// The metric's contacts at a friction.
WrenchModel WrenchModelOf(const MetricOptions& options, double friction);

// Epsilon of the grasp as executed under one draw: the object (its centre of mass with it) and the
// gripper are displaced, the jaws close anew. 0 when a jaw misses, starts inside or slips.
// Everything is computed in the moved object's own frame, by moving the gripper the other way: the
// friction pyramid's first edge follows the object's +x axis wherever the object is, so that only
// the pose of the gripper relative to the object matters.
double ExecutedQuality(const RayScene& scene, const Eigen::Vector3d& com, const Grasp& grasp,
                       const MetricOptions& options, const NoiseDraw& noise);

// The same of many draws, bit for bit; see CloseJawsTogether.
void ExecutedQualities(const RayScene& scene, const Eigen::Vector3d& com, const Grasp& grasp,
                       const MetricOptions& options, std::span<const NoiseDraw> draws,
                       std::span<double> qualities);

// Mean of ExecutedQuality over options.num_draws draws.
double RobustQuality(const RayScene& scene, const Eigen::Vector3d& com, const Grasp& grasp,
                     const MetricOptions& options, RngStream* rng);

}  // namespace antigrasp
