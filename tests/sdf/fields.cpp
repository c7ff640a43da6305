#include "tests/sdf/fields.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/core/rng.h"

namespace antigrasp {

SdfGrid Sampled(int n, const std::function<double(const Eigen::Vector3d&)>& f) {
  SdfGrid grid = UnitCubeGrid(n);
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        grid.values[grid.Index(x, y, z)] = static_cast<float>(f(grid.Node(x, y, z)));
      }
    }
  }
  return grid;
}

SdfGrid WhiteNoise(int n, std::uint64_t seed) {
  RngStream rng(seed, "white-noise");
  SdfGrid grid = UnitCubeGrid(n);
  for (float& v : grid.values) v = static_cast<float>(rng.Uniform(-1.0, 1.0));
  return grid;
}

double SphereDistance(const Eigen::Vector3d& p, double radius) { return radius - p.norm(); }

double BoxDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& extents) {
  const Eigen::Vector3d q = p.cwiseAbs() - 0.5 * extents;
  return -(q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0));
}

double TorusDistance(const Eigen::Vector3d& p, double ring, double tube) {
  return tube - std::hypot(p.head<2>().norm() - ring, p.z());
}

}  // namespace antigrasp
