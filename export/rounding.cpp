#include "antigrasp/export/rounding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace antigrasp {
namespace {

constexpr double kLengths = 1e-4;  // share of a limit
constexpr double kAngles = 1e-4;   // radians
constexpr double kMostTurn = 0.05;
// Three coordinates of one corner, and of the corner across.
constexpr double kTwoCorners = 2.0 * std::numbers::sqrt3;
constexpr double kExtent = 2.0;  // between two coordinates

}  // namespace

double LengthSlack(double limit, double rounding) {
  return kLengths * limit + (kTwoCorners + kExtent) * rounding;
}

double AngleSlack(const TriangleMesh& mesh, std::size_t face, double rounding) {
  const auto corner = [&](std::size_t k) {
    return mesh.vertices[static_cast<std::size_t>(mesh.faces[face][k % 3])];
  };
  double longest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    longest = std::max(longest, (corner(k + 1) - corner(k)).norm());
  }
  const double turn = kTwoCorners * rounding * longest / FaceCross(mesh, face).norm();
  return std::min(kMostTurn, kAngles + turn);
}

}  // namespace antigrasp
