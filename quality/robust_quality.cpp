#include "antigrasp/quality/robust_quality.h"

#include "antigrasp/quality/jaw_closing.h"

namespace antigrasp {

using Eigen::Vector3d;

WrenchModel WrenchModelOf(const MetricOptions& options, double friction) {
  return {friction, options.cone_edges, options.finger_radius, options.torque_scale,
          options.torsion};
}

double ExecutedQuality(const RayScene& scene, const Vector3d& com, const Grasp& grasp,
                       const MetricOptions& options, const NoiseDraw& noise) {
  const JawPose pose = ExecutedPose(grasp, com, noise);
  const auto contacts =
      CloseJaws(scene, pose.center, pose.axis, options.jaw_opening, noise.friction);
  if (!contacts) return 0.0;
  return Epsilon(*contacts, com, WrenchModelOf(options, noise.friction));
}

double RobustQuality(const RayScene& scene, const Vector3d& com, const Grasp& grasp,
                     const MetricOptions& options, RngStream* rng) {
  double sum = 0.0;
  for (int draw = 0; draw < options.num_draws; ++draw) {
    sum += ExecutedQuality(scene, com, grasp, options, DrawNoise(options, rng));
  }
  return sum / options.num_draws;
}

}  // namespace antigrasp
