#pragma once

#include <Eigen/Core>
#include <limits>

namespace antigrasp {

// A solid round cone with its apex at the origin: the directions within an angle of the axis.
// Closed, and wider by kConeSlack in the cosine, so that what lies on the rim on paper is inside.
inline constexpr double kConeSlack = 1e-12;
struct Cone {
  Cone(const Eigen::Vector3d& unit_axis, double half_angle);  // half_angle in [0, pi / 2)
  bool Contains(const Eigen::Vector3d& direction) const;      // false for zero
  Eigen::Vector3d axis;
  double cosine;  // of the half angle, less the slack
};

// Parameters low..high of a line; empty when low > high.
struct Range {
  double low, high;
  bool empty() const { return !(low <= high); }
};
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// The part of start + s * step, s in `range`, that lies in the cone: one range, because cones are
// convex. Closed form (one square root). The apex itself counts as inside.
Range ClipToCone(const Eigen::Vector3d& start, const Eigen::Vector3d& step, const Cone& cone,
                 Range range);

}  // namespace antigrasp
