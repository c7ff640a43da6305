#pragma once

#include <Eigen/Core>
#include <array>

#include "antigrasp/contact/tip_pose.h"

namespace antigrasp {

// Corners relative to the pad's centre, along its axes.
std::array<Eigen::Vector3d, 3> InPadFrame(const PadPose& pad,
                                          const std::array<Eigen::Vector3d, 3>& corners);

// Lower bound of the distance from the pad's box to a triangle given in its frame: the largest gap
// between their shadows along an axis that can part them (those of BoxMeetsTriangle). 0 where they
// meet.
double PadGap(const PadPose& pad, const std::array<Eigen::Vector3d, 3>& corners);

}  // namespace antigrasp
