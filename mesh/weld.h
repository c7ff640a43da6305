#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace antigrasp {

// For every position the index of the first one at exactly the same place (0 equals -0).
std::vector<std::int32_t> FirstEqual(const std::vector<Eigen::Vector3d>& positions);

// For every position the first one of its cluster: positions within `tolerance` of each other, also
// through others in between, are one cluster.
std::vector<std::int32_t> FirstNear(const std::vector<Eigen::Vector3d>& positions,
                                    double tolerance);

}  // namespace antigrasp
