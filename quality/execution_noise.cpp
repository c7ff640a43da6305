#include "antigrasp/quality/execution_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNormals = 13;

NoiseDraw NoiseOf(const MetricOptions& options, const double* normals) {
  const auto next = [&normals](double std) {
    const Vector3d v(std * normals[0], std * normals[1], std * normals[2]);
    normals += 3;
    return v;
  };
  NoiseDraw draw;
  draw.object_translation = next(options.object_translation_std);
  draw.object_rotation = next(options.object_rotation_std);
  draw.grasp_translation = next(options.grasp_translation_std);
  draw.grasp_rotation = next(options.grasp_rotation_std);
  draw.friction = std::max(0.0, options.friction + options.friction_std * *normals);
  return draw;
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
  std::array<double, kNormals> normals;
  for (double& normal : normals) normal = rng->Normal();
  return NoiseOf(options, normals.data());
}

void DrawNoises(const MetricOptions& options, RngStream* rng, std::span<NoiseDraw> draws) {
  std::vector<double> normals(kNormals * draws.size());
  rng->Normals(normals);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    draws[i] = NoiseOf(options, &normals[kNormals * i]);
  }
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
