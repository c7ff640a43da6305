#pragma once

#include <Eigen/Core>
#include <array>

namespace antigrasp {

// Whether a triangle meets the closed box of these half extents about the origin: separating axes
// (Akenine-Moeller, "Fast 3D triangle-box overlap testing", 2001). Every axis projects all it
// needs, so that a triangle without area is tested as the segment or point that it is. Wrong only
// where the two miss or overlap by rounding (1e-16 of their coordinates).
bool BoxMeetsTriangle(const Eigen::Vector3d& half_extents,
                      const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace antigrasp
