#include "antigrasp/perturb/cone.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace antigrasp {
namespace {

constexpr Range kNothing{1.0, 0.0};

Range Overlap(const Range& a, const Range& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

// Where a s^2 + 2 b s + c has its zeros, in order; without the loss of digits of the school
// formula.
Range Zeros(double a, double b, double c) {
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double q = b < 0.0 ? root - b : -(root + b);
  const double first = q / a;
  const double second = q != 0.0 ? c / q : first;
  return {std::min(first, second), std::max(first, second)};
}

}  // namespace

Cone::Cone(const Eigen::Vector3d& unit_axis, double half_angle)
    : axis(unit_axis), cosine(std::cos(half_angle) - kConeSlack) {}

bool Cone::Contains(const Eigen::Vector3d& direction) const {
  const double along = axis.dot(direction);
  return along > 0.0 && along * along >= cosine * cosine * direction.squaredNorm();
}

// x is in the cone or its mirror image where f(s) = (x . axis)^2 - cosine^2 |x|^2 >= 0. A line that
// is flatter than the cone (a < 0) meets one of the two only, in the span between f's zeros; a
// steeper one goes through both and is in the cone beyond one zero.
Range ClipToCone(const Eigen::Vector3d& start, const Eigen::Vector3d& step, const Cone& cone,
                 Range range) {
  const double height = cone.axis.dot(start), rise = cone.axis.dot(step);
  const double square = cone.cosine * cone.cosine;
  const double a = rise * rise - square * step.squaredNorm();
  const double b = height * rise - square * start.dot(step);
  const double c = height * height - square * start.squaredNorm();
  if (a < 0.0) {
    if (b * b < a * c) return kNothing;
    const Range zeros = Zeros(a, b, c);
    const bool mirrored = height + 0.5 * (zeros.low + zeros.high) * rise < 0.0;
    return mirrored ? kNothing : Overlap(range, zeros);
  }
  if (a > 0.0) {
    const Range zeros = Zeros(a, b, c);
    return Overlap(range,
                   rise > 0.0 ? Range{zeros.high, kUnbounded} : Range{-kUnbounded, zeros.low});
  }
  if (rise > 0.0 && b > 0.0) return Overlap(range, {-0.5 * c / b, kUnbounded});
  if (rise < 0.0 && b < 0.0) return Overlap(range, {-kUnbounded, -0.5 * c / b});
  if (b != 0.0 || c < 0.0) return kNothing;
  if (rise == 0.0) return height >= 0.0 ? range : kNothing;
  const double apex = -height / rise;  // the line runs along the cone's surface
  return Overlap(range, rise > 0.0 ? Range{apex, kUnbounded} : Range{-kUnbounded, apex});
}

}  // namespace antigrasp
