#include "antigrasp/contact/box_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace antigrasp {

using Eigen::Vector3d;

bool BoxMeetsTriangle(const Vector3d& half_extents, const std::array<Vector3d, 3>& corners) {
  const Vector3d& h = half_extents;
  const auto& [a, b, c] = corners;
  for (int k = 0; k < 3; ++k) {
    if (std::min({a[k], b[k], c[k]}) > h[k] || std::max({a[k], b[k], c[k]}) < -h[k]) return false;
  }
  // A box axis cross an edge: both ends of the edge project to the same number.
  for (std::size_t e = 0; e < 3; ++e) {
    const Vector3d& p = corners[e];
    const Vector3d& q = corners[(e + 2) % 3];
    const Vector3d edge = corners[(e + 1) % 3] - p;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3;
      const int j = (k + 2) % 3;
      const double at_p = edge[i] * p[j] - edge[j] * p[i];
      const double at_q = edge[i] * q[j] - edge[j] * q[i];
      const double reach = h[i] * std::abs(edge[j]) + h[j] * std::abs(edge[i]);
      if (std::min(at_p, at_q) > reach || std::max(at_p, at_q) < -reach) return false;
    }
  }
  // The normal of a needle is rounding only; still a valid axis when all three corners project.
  const Vector3d normal = (b - a).cross(c - a);
  const double reach = normal.cwiseAbs().dot(h);
  const double at_a = normal.dot(a);
  const double at_b = normal.dot(b);
  const double at_c = normal.dot(c);
  return std::min({at_a, at_b, at_c}) <= reach && std::max({at_a, at_b, at_c}) >= -reach;
}

}  // namespace antigrasp
