#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// A unit vector uniform over the sphere; two uniform numbers.
inline Eigen::Vector3d DrawDirection(RngStream* rng) {
  const double z = rng->Uniform(-1.0, 1.0);  // area on the sphere is proportional to height
  const double around = rng->Uniform(0.0, 2.0 * std::numbers::pi);
  const double radius = std::sqrt(1.0 - z * z);
  return {radius * std::cos(around), radius * std::sin(around), z};
}

}  // namespace antigrasp
