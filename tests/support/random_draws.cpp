#include "tests/support/random_draws.h"

#include <Eigen/Geometry>
#include <numbers>

namespace antigrasp {

Eigen::Vector3d DrawPoint(double std, RngStream* rng) {
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) v[k] = std * rng->Normal();
  return v;
}

Eigen::Vector3d DrawDirection(RngStream* rng) { return DrawPoint(1.0, rng).normalized(); }

Eigen::Matrix3d DrawRotation(RngStream* rng) {
  const double angle = rng->Uniform(0.0, std::numbers::pi);
  return Eigen::AngleAxisd(angle, DrawDirection(rng)).toRotationMatrix();
}

}  // namespace antigrasp
