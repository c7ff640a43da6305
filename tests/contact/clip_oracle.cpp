#include "tests/contact/clip_oracle.h"

#include <vector>

namespace antigrasp {

using Eigen::Vector3d;

bool ClippedTriangleRemains(const std::array<Vector3d, 3>& corners, const Vector3d& min,
                            const Vector3d& max) {
  std::vector<Vector3d> polygon(corners.begin(), corners.end());
  for (int k = 0; k < 3; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      // Kept: depth >= 0.
      const double limit = sign > 0.0 ? max[k] : min[k];
      const auto depth = [&](const Vector3d& p) { return sign * (limit - p[k]); };
      std::vector<Vector3d> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3d& from = polygon[i];
        const Vector3d& to = polygon[(i + 1) % polygon.size()];
        if (depth(from) >= 0.0) kept.push_back(from);
        if ((depth(from) >= 0.0) != (depth(to) >= 0.0)) {
          const double t = depth(from) / (depth(from) - depth(to));
          kept.push_back(from + t * (to - from));
        }
      }
      polygon = kept;
    }
  }
  return !polygon.empty();
}

}  // namespace antigrasp
