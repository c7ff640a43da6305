#include "antigrasp/bundle/solid_test.h"

#include <limits>

namespace antigrasp {

bool SolidTest::Inside(const Eigen::Vector3d& point) const {
  static const Eigen::Vector3d way(0.36, 0.48, 0.8);  // along no axis or diagonal
  const auto hit = rays_.Closest(point, way, std::numeric_limits<double>::max());
  return hit && !hit->front;
}

}  // namespace antigrasp
