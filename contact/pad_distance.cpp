#include "antigrasp/contact/pad_distance.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Below this length (metres, of a unit vector and an edge) a cross product is rounding.
constexpr double kNoAxis = 1e-12;

}  // namespace

std::array<Vector3d, 3> InPadFrame(const PadPose& pad, const std::array<Vector3d, 3>& corners) {
  const auto frame = pad.axes.transpose();
  return {frame * (corners[0] - pad.center), frame * (corners[1] - pad.center),
          frame * (corners[2] - pad.center)};
}

double PadGap(const PadPose& pad, const std::array<Vector3d, 3>& corners) {
  const auto& [a, b, c] = corners;
  double gap = 0.0;
  const auto part = [&](const Vector3d& axis) {
    const double length = axis.norm();
    if (length < kNoAxis) return;
    const auto [low, high] = std::minmax({axis.dot(a), axis.dot(b), axis.dot(c)});
    const double reach = axis.cwiseAbs().dot(pad.half);
    gap = std::max({gap, (low - reach) / length, (-high - reach) / length});
  };
  for (int k = 0; k < 3; ++k) {
    part(Vector3d::Unit(k));
    for (int e = 0; e < 3; ++e) part(Vector3d::Unit(k).cross(corners[(e + 1) % 3] - corners[e]));
  }
  part((b - a).cross(c - a));
  return gap;
}

}  // namespace antigrasp
