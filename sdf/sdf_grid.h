#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace antigrasp {

// A cubic grid of signed distances, POSITIVE INSIDE (paper, equation V.1). Node (x, y, z) lies at
// origin + spacing * (x, y, z); values are stored x fastest, z slowest, which is a tensor's
// [D = z, H = y, W = x]. The standard grid is 32^3 over the unit cube [-0.5, 0.5]^3 with nodes at
// cell centres: spacing 1/32 = 0.03125 (paper, VI-C), origin -0.5 + 1/64 on each axis.
struct SdfGrid {
  int n = 32;
  double spacing = 1.0 / 32;
  Eigen::Vector3d origin = Eigen::Vector3d::Constant(-0.5 + 1.0 / 64);
  std::vector<float> values;  // n*n*n

  std::size_t Index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(n) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(n) +
           static_cast<std::size_t>(x);
  }
  Eigen::Vector3d Node(int x, int y, int z) const {
    return origin + spacing * Eigen::Vector3d(x, y, z);
  }
};

// Cells that stay free between a shape and each side of its grid: prior sets, imported meshes and
// figures.
inline constexpr double kFreeCells = 2.0;

// The standard grid of n^3 nodes over the unit cube, values zero.
SdfGrid UnitCubeGrid(int n = 32);

}  // namespace antigrasp
