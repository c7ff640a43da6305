#pragma once

#include <Eigen/Core>
#include <vector>

namespace antigrasp {

// minimise |a x - b|^2 + regularizer |x|^2  over  x >= 0,  sum of x_i in each group <= limit.
struct LimitedLeastSquares {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
  double regularizer = 1e-10;  // > 0: the minimiser is unique
  std::vector<int> group;      // of each x_i, from 0 on; -1 belongs to none
  double limit = 1.0;          // > 0
};

// The minimiser, by an active-set method that ends at it: no tolerance of convergence, no start
// value. About 20 small QR factorisations for a grasp of two contacts. The numbers in `a` and `b`
// are finite.
Eigen::VectorXd Solve(const LimitedLeastSquares& problem);

}  // namespace antigrasp
