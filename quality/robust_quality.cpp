#include "antigrasp/quality/robust_quality.h"

#include <vector>

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

void ExecutedQualities(const RayScene& scene, const Vector3d& com, const Grasp& grasp,
                       const MetricOptions& options, std::span<const NoiseDraw> draws,
                       std::span<double> qualities) {
  std::vector<JawClosing> closings;
  closings.reserve(draws.size());
  for (const NoiseDraw& noise : draws) {
    const JawPose pose = ExecutedPose(grasp, com, noise);
    closings.push_back({pose.center, pose.axis, noise.friction});
  }
  std::vector<std::optional<std::array<Contact, 2>>> contacts(draws.size());
  CloseJawsTogether(scene, closings, options.jaw_opening, contacts);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    qualities[i] =
        contacts[i] ? Epsilon(*contacts[i], com, WrenchModelOf(options, draws[i].friction)) : 0.0;
  }
}

double RobustQuality(const RayScene& scene, const Vector3d& com, const Grasp& grasp,
                     const MetricOptions& options, RngStream* rng) {
  std::vector<NoiseDraw> draws(static_cast<std::size_t>(options.num_draws));
  std::vector<double> qualities(draws.size());
  DrawNoises(options, rng, draws);
  ExecutedQualities(scene, com, grasp, options, draws, qualities);
  double sum = 0.0;
  for (const double quality : qualities) sum += quality;
  return sum / options.num_draws;
}

}  // namespace antigrasp
