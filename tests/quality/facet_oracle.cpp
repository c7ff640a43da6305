#include "tests/quality/facet_oracle.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>

namespace antigrasp {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// Advances `pick` to the next 6-subset of {0, ..., count - 1}.
bool NextSubset(std::array<int, 6>* pick, int count) {
  for (int k = 5; k >= 0; --k) {
    auto& value = (*pick)[static_cast<std::size_t>(k)];
    if (value < count - 6 + k) {
      ++value;
      for (int m = k + 1; m < 6; ++m) (*pick)[static_cast<std::size_t>(m)] = value + m - k;
      return true;
    }
  }
  return false;
}

}  // namespace

double EpsilonByFacets(const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrenches) {
  // The facets do not depend on the unit of torque: balance it for the arithmetic, undo it in the
  // distance.
  const double torque_unit = wrenches.bottomRows<3>().norm() / wrenches.topRows<3>().norm();
  Eigen::Matrix<double, 6, Eigen::Dynamic> balanced = wrenches;
  balanced.bottomRows<3>() /= torque_unit;
  const double tolerance = 1e-9 * balanced.norm();
  const int count = static_cast<int>(wrenches.cols());
  double epsilon = std::numeric_limits<double>::infinity();
  std::array<int, 6> pick{0, 1, 2, 3, 4, 5};
  do {
    Eigen::Matrix<double, 6, 7> rows;  // normal . w - offset = 0 on the facet
    for (int k = 0; k < 6; ++k) {
      rows.row(k) << balanced.col(pick[static_cast<std::size_t>(k)]).transpose(), -1.0;
    }
    Eigen::FullPivLU<Eigen::Matrix<double, 6, 7>> lu(rows);
    lu.setThreshold(1e-8);
    if (lu.dimensionOfKernel() != 1) continue;
    Eigen::Matrix<double, 7, 1> plane = lu.kernel();
    const double length = plane.head<6>().norm();
    if (length < 1e-12 * plane.norm()) continue;
    plane /= length;
    const Eigen::VectorXd side = balanced.transpose() * plane.head<6>();
    if (side.minCoeff() >= plane[6] - tolerance) plane = -plane;
    const bool facet = (plane.head<6>().transpose() * balanced).maxCoeff() <= plane[6] + tolerance;
    if (!facet) continue;
    Vector6 normal = plane.head<6>();
    normal.tail<3>() /= torque_unit;
    epsilon = std::min(epsilon, plane[6] / normal.norm());
  } while (NextSubset(&pick, count));
  return epsilon > 1e-10 ? epsilon : 0.0;
}

}  // namespace antigrasp
