#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace antigrasp {

struct FaceMiddle {
  Eigen::Vector3f at;
  std::uint32_t face;
};

// All faces in an order in which every eight, and groups of eight of these, and groups of groups,
// lie near each other: cut across the longest side of what is left of `box`, at the middles of the
// faces. 0.1 ms for 3,000 faces.
std::vector<FaceMiddle> BlockOrder(const std::vector<Eigen::Vector3f>& vertices,
                                   const std::vector<std::array<std::int32_t, 3>>& corners,
                                   const Eigen::AlignedBox3f& box);

}  // namespace antigrasp
