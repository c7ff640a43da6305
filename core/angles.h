// Options and tables hold degrees, the mathematics takes radians: 30 * kDegree is an angle, angle /
// kDegree a number to show.
#pragma once

#include <numbers>

namespace antigrasp {

inline constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace antigrasp
