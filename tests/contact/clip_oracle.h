#pragma once

#include <Eigen/Core>
#include <array>

namespace antigrasp {

// Whether something of the triangle is left after clipping it by the six sides of the closed box
// [min, max] (Sutherland and Hodgman 1974). Another way than separating axes to the same answer.
bool ClippedTriangleRemains(const std::array<Eigen::Vector3d, 3>& corners,
                            const Eigen::Vector3d& min, const Eigen::Vector3d& max);

}  // namespace antigrasp
