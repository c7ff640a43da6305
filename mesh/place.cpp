#include "antigrasp/mesh/place.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace antigrasp {

Eigen::Vector3d RoundPlace(const TriangleMesh& mesh) { return RoundPlace(Bounds(mesh)); }

Eigen::Vector3d RoundPlace(const BoundingBox& box) {
  // A little less, so that rounding chooses nothing for extents of 100 or 0.1.
  const double least = 0.999 * 2.0 * box.Extent().maxCoeff();
  double step = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {2.0, 2.5, 2.0}) {  // 1, 2, 5, 10
    if (step < least) step *= factor;
  }
  const Eigen::Vector3d steps = (box.Center() / step).array().round();
  // A tenth is no double, but a number of tenths divided by ten is the one that text is read as.
  const Eigen::Vector3d scaled =
      step < 1.0 ? Eigen::Vector3d(steps / std::round(1.0 / step)) : Eigen::Vector3d(step * steps);
  const Eigen::Vector3d place = scaled + Eigen::Vector3d::Zero();  // no negative zeros
  return place.allFinite() ? place : Eigen::Vector3d::Zero();
}

double SinglePrecisionLoss(const TriangleMesh& mesh) {
  const BoundingBox box = Bounds(mesh);
  return std::ldexp(std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff()), -24);
}

double RoundedBy(const TriangleMesh& mesh) {
  constexpr std::uint32_t kLastBits = 0x7;  // three of 24
  double rounded = 0.0;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    for (const double x : v) {
      const volatile float stored = static_cast<float>(x);  // volatile: see InSinglePrecision
      const float single = stored;
      if (static_cast<double>(single) != x) return 0.0;
      const bool is_long = (std::bit_cast<std::uint32_t>(single) & kLastBits) != 0;
      if (is_long) rounded = std::max(rounded, std::ldexp(std::abs(x), -24));
    }
  }
  return rounded;
}

}  // namespace antigrasp
