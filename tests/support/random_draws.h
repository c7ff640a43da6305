#pragma once

#include <Eigen/Core>

#include "antigrasp/core/rng.h"

namespace antigrasp {

Eigen::Vector3d DrawPoint(double std, RngStream* rng);  // normal about the origin
Eigen::Vector3d DrawDirection(RngStream* rng);          // uniform, unit length
Eigen::Matrix3d DrawRotation(RngStream* rng);           // by an angle uniform in [0, pi]

}  // namespace antigrasp
