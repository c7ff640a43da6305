#pragma once

#include <cstdint>
#include <functional>

#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// The unit-cube grid with values f(node).
SdfGrid Sampled(int n, const std::function<double(const Eigen::Vector3d&)>& f);

// Independent values in [-1, 1): the hardest input that a generator can make.
SdfGrid WhiteNoise(int n, std::uint64_t seed);

// Exact signed distances, positive inside, centred at the origin.
double SphereDistance(const Eigen::Vector3d& p, double radius);
double BoxDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& extents);
double TorusDistance(const Eigen::Vector3d& p, double ring, double tube);  // around z

}  // namespace antigrasp
