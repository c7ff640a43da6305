#include "antigrasp/quality/robust_quality.h"

#include <algorithm>

#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/jaw_closing.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

Vector3d NormalVector(double std, RngStream* rng) {
  Vector3d v;
  for (int k = 0; k < 3; ++k) v[k] = std * rng->Normal();
  return v;
}

// The matrix exponential of the cross-product matrix of `v`.
Eigen::Matrix3d RotationFromVector(const Vector3d& v) {
  const double angle = v.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, v / angle).toRotationMatrix();
}

}  // namespace

NoiseDraw DrawNoise(const MetricOptions& options, RngStream* rng) {
  NoiseDraw draw;
  draw.object_translation = NormalVector(options.object_translation_std, rng);
  draw.object_rotation = NormalVector(options.object_rotation_std, rng);
  draw.grasp_translation = NormalVector(options.grasp_translation_std, rng);
  draw.grasp_rotation = NormalVector(options.grasp_rotation_std, rng);
  draw.friction = std::max(0.0, options.friction + options.friction_std * rng->Normal());
  return draw;
}

double ExecutedQuality(const RayScene& scene, const Vector3d& com, const Grasp& grasp,
                       const MetricOptions& options, const NoiseDraw& noise) {
  const Eigen::Matrix3d object_from_world = RotationFromVector(noise.object_rotation).transpose();
  const Vector3d center_in_world = grasp.center + noise.grasp_translation;
  const Vector3d axis_in_world = RotationFromVector(noise.grasp_rotation) * grasp.axis;
  const Vector3d center =
      object_from_world * (center_in_world - com - noise.object_translation) + com;
  const Vector3d axis = object_from_world * axis_in_world;
  const auto contacts = CloseJaws(scene, center, axis, options.jaw_opening, noise.friction);
  if (!contacts) return 0.0;
  const WrenchModel model{noise.friction, options.cone_edges, options.finger_radius,
                          options.torque_scale};
  return Epsilon(*contacts, com, model);
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
