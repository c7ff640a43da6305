#include "tests/support/rippled_solid.h"

#include <cmath>
#include <numbers>

namespace antigrasp {

TriangleMesh RippledSolid(int rings) {
  const int around = 2 * rings;
  TriangleMesh mesh;
  const auto add = [&mesh](double x, double y, double z) {
    const double ripple = std::sin(5 * x + 1) * std::sin(4 * y + 2) * std::sin(3 * z + 0.5);
    mesh.vertices.push_back(0.05 * (1.0 + 0.01 * ripple) * Eigen::Vector3d(x, y, z));
  };
  add(0, 0, 1);
  for (int i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < around; ++j) {
      const double turn = 2.0 * std::numbers::pi * j / around;
      add(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
    }
  }
  add(0, 0, -1);
  const int south = static_cast<int>(mesh.vertices.size()) - 1;
  for (int j = 0; j < around; ++j) {
    const int k = (j + 1) % around;
    mesh.faces.push_back({0, 1 + j, 1 + k});
    for (int i = 0; i + 2 < rings; ++i) {
      const int upper = 1 + i * around, lower = upper + around;
      mesh.faces.push_back({upper + j, lower + j, lower + k});
      mesh.faces.push_back({upper + j, lower + k, upper + k});
    }
    mesh.faces.push_back({south, south - around + k, south - around + j});
  }
  return mesh;
}

}  // namespace antigrasp
