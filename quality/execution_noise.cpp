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

// Turns points by a rotation vector (Rodrigues).
class Turn {
 public:
  explicit Turn(const Vector3d& turn) : angle_(turn.norm()) {
    if (!(angle_ > 0.0)) return;
    axis_ = turn / angle_;
    cosine_ = std::cos(angle_);
    sine_ = std::sin(angle_);
  }
  Vector3d operator()(const Vector3d& point) const {
    if (!(angle_ > 0.0)) return point;
    return cosine_ * point + sine_ * axis_.cross(point) +
           (1.0 - cosine_) * axis_.dot(point) * axis_;
  }

 private:
  double angle_, cosine_ = 1.0, sine_ = 0.0;
  Vector3d axis_ = Vector3d::UnitX();
};

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
  const Vector3d axis_in_world = Turn(noise.grasp_rotation)(grasp.axis);
  const Turn back(-noise.object_rotation);
  return {back(center_in_world - com - noise.object_translation) + com,
          back(axis_in_world).normalized()};
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
