#include "antigrasp/quality/execution_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

Vector3d NormalVector(double std, RngStream* rng) {
  Vector3d v;
  for (int k = 0; k < 3; ++k) v[k] = std * rng->Normal();
  return v;
}

// `point` turned by the rotation vector `turn` (Rodrigues).
Vector3d Turned(const Vector3d& point, const Vector3d& turn) {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return point;
  const Vector3d axis = turn / angle;
  const double cosine = std::cos(angle);
  return cosine * point + std::sin(angle) * axis.cross(point) +
         (1.0 - cosine) * axis.dot(point) * axis;
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

JawPose ExecutedPose(const Grasp& grasp, const Vector3d& com, const NoiseDraw& noise) {
  const Vector3d center_in_world = grasp.center + noise.grasp_translation;
  const Vector3d axis_in_world = Turned(grasp.axis, noise.grasp_rotation);
  const Vector3d back = -noise.object_rotation;
  return {Turned(center_in_world - com - noise.object_translation, back) + com,
          Turned(axis_in_world, back).normalized()};
}

Eigen::Isometry3d GripperFrame(const Grasp& grasp, const JawPose& jaws) {
  Vector3d in = grasp.approach;
  if (in.isZero()) in = -jaws.axis.unitOrthogonal();
  in = (in - in.dot(jaws.axis) * jaws.axis).normalized();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear().col(0) = jaws.axis;
  frame.linear().col(1) = (-in).cross(jaws.axis);
  frame.linear().col(2) = -in;
  frame.translation() = jaws.center;
  return frame;
}

}  // namespace antigrasp
