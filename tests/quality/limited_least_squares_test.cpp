#include "antigrasp/quality/limited_least_squares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

// The conditions of Karush, Kuhn and Tucker, which make x the minimiser of a convex programme:
// feasible; in each group one price for more of it, 0 below the limit; no x_i worth more than the
// price, none that is positive worth less.
void ExpectMinimiser(const LimitedLeastSquares& problem, const Eigen::VectorXd& x, double tolerance,
                     int id) {
  const LongVector exact = x.cast<long double>();
  const auto a = problem.a.cast<long double>().eval();
  const LongVector worth = a.transpose() * (problem.b.cast<long double>() - a * exact) -
                           static_cast<long double>(problem.regularizer) * exact;
  const double unit = problem.a.norm() * (problem.b.norm() + problem.a.norm() * x.norm());
  const auto noise = static_cast<long double>(tolerance * unit);
  for (int g = -1; g <= *std::max_element(problem.group.begin(), problem.group.end()); ++g) {
    double sum = 0.0;
    long double price = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (problem.group[static_cast<std::size_t>(i)] != g) continue;
      sum += x[i];
      if (x[i] > 0.0) price = std::max(price, worth[i]);
    }
    if (g < 0) {
      price = 0.0;
    } else {
      EXPECT_LE(sum, problem.limit * (1.0 + 1e-14)) << id;
      if (sum < problem.limit * (1.0 - 1e-12)) price = 0.0;
    }
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (problem.group[static_cast<std::size_t>(i)] != g) continue;
      EXPECT_GE(x[i], 0.0) << id;
      EXPECT_LE(worth[i], price + noise) << id << " column " << i;
      if (x[i] > 0.0) {
        EXPECT_GE(worth[i], price - noise) << id << " column " << i;
      }
    }
  }
}

LimitedLeastSquares Plane(double b1, double b2) {
  LimitedLeastSquares problem;
  problem.a = Eigen::Matrix2d::Identity();
  problem.b = Eigen::Vector2d(b1, b2);
  problem.regularizer = 1e-14;
  problem.group = {0, 0};
  problem.limit = 2.0;
  return problem;
}

TEST(LimitedLeastSquares, ProjectsOnTheTriangleOfNonNegativePointsBelowTheLimit) {
  const auto expect = [](double b1, double b2, double x1, double x2) {
    const Eigen::VectorXd x = Solve(Plane(b1, b2));
    EXPECT_NEAR(x[0], x1, 1e-13) << b1 << " " << b2;
    EXPECT_NEAR(x[1], x2, 1e-13) << b1 << " " << b2;
  };
  expect(0.5, 0.25, 0.5, 0.25);  // inside
  expect(2.0, 1.0, 1.5, 0.5);    // over the long side
  expect(3.0, 0.5, 2.0, 0.0);    // beyond its end
  expect(-1.0, 0.75, 0.0, 0.75);
  expect(-1.0, -2.0, 0.0, 0.0);
  expect(-1.0, 9.0, 0.0, 2.0);
  expect(0.0, 0.0, 0.0, 0.0);
  expect(1.0, 1.0, 1.0, 1.0);  // on the side already
}

TEST(LimitedLeastSquares, LimitsBindEachGroupAloneAndNothingOutside) {
  LimitedLeastSquares problem;
  problem.a = Eigen::MatrixXd::Identity(4, 4);
  problem.b = Eigen::Vector4d(5.0, 1.0, 7.0, 9.0);
  problem.group = {0, 1, -1, 0};
  problem.limit = 8.0;
  problem.regularizer = 1e-14;
  const Eigen::VectorXd x = Solve(problem);
  EXPECT_NEAR(x[0], 2.0, 1e-12);  // 5 and 9 down by 3 each
  EXPECT_NEAR(x[3], 6.0, 1e-12);
  EXPECT_NEAR(x[1], 1.0, 1e-12);
  EXPECT_NEAR(x[2], 7.0, 1e-12);
}

TEST(LimitedLeastSquares, RegulariserSharesAmongEqualColumnsAndChoosesTheStrongerOfTwo) {
  LimitedLeastSquares problem;
  problem.a = Eigen::RowVector3d(1.0, 1.0, 1.0);
  problem.b = Eigen::VectorXd::Constant(1, 6.0);
  problem.group = {0, 0, 1};
  problem.limit = 100.0;
  Eigen::VectorXd x = Solve(problem);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(x[i], 2.0, 1e-9);
  problem.limit = 2.5;  // 2.5 in group 0, the rest from group 1
  x = Solve(problem);
  EXPECT_NEAR(x[0], 1.25, 1e-9);
  EXPECT_NEAR(x[1], 1.25, 1e-9);
  EXPECT_NEAR(x[2], 2.5, 1e-9);
  problem.a = Eigen::RowVector3d(1.0, 3.0, -1.0);
  problem.limit = 100.0;
  x = Solve(problem);  // least norm on x + 3 y = 6
  EXPECT_NEAR(x[0], 0.6, 1e-9);
  EXPECT_NEAR(x[1], 1.8, 1e-9);
  EXPECT_EQ(x[2], 0.0);
}

TEST(LimitedLeastSquares, MeetsTheOptimalityConditionsOnRandomProblems) {
  for (std::uint64_t i = 0; i < 1500; ++i) {
    RngStream rng(31, "problems", i);
    const auto rows = static_cast<Eigen::Index>(1 + rng.Below(6));
    const auto columns = static_cast<Eigen::Index>(1 + rng.Below(24));
    LimitedLeastSquares problem;
    problem.a = Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return rng.Normal(); });
    problem.b = Eigen::VectorXd::NullaryExpr(rows, [&] { return 5.0 * rng.Normal(); });
    // Half of them as a grasp has it: forces of 1 beside torques of up to 1000.
    if (i % 2 == 0) problem.a.bottomRows(rows / 2) *= std::pow(10.0, rng.Uniform(-3.0, 3.0));
    for (Eigen::Index k = 0; k < columns; ++k) {
      problem.group.push_back(static_cast<int>(rng.Below(4)) - 1);
    }
    problem.limit = rng.Uniform(0.01, 5.0);
    problem.regularizer = std::pow(10.0, rng.Uniform(-12.0, -2.0));
    ExpectMinimiser(problem, Solve(problem), 1e-15, static_cast<int>(i));
  }
}

TEST(LimitedLeastSquares, EndsAtTheMinimiserWhereWholeNumbersMakeTies) {
  // Parallel, opposite and zero columns, limits met on the way by several at once.
  for (std::uint64_t i = 0; i < 5000; ++i) {
    RngStream rng(32, "ties", i);
    const auto whole = [&](int span) {
      return static_cast<double>(rng.Below(static_cast<std::uint64_t>(2 * span + 1))) - span;
    };
    const auto rows = static_cast<Eigen::Index>(1 + rng.Below(6));
    const auto columns = static_cast<Eigen::Index>(1 + rng.Below(14));
    LimitedLeastSquares problem;
    problem.a = Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return whole(2); });
    problem.b = Eigen::VectorXd::NullaryExpr(rows, [&] { return whole(3); });
    for (Eigen::Index k = 0; k < columns; ++k) {
      problem.group.push_back(static_cast<int>(rng.Below(4)) - 1);
    }
    problem.limit = 1.0 + static_cast<double>(rng.Below(3));
    problem.regularizer = std::pow(10.0, -2.0 - static_cast<double>(rng.Below(11)));
    ExpectMinimiser(problem, Solve(problem), 1e-15, static_cast<int>(i));
  }
}

TEST(LimitedLeastSquares, RefusesWhatHasNoUniqueMinimiser) {
  LimitedLeastSquares problem = Plane(1.0, 1.0);
  problem.regularizer = 0.0;
  EXPECT_THROW(Solve(problem), std::logic_error);
  problem = Plane(1.0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(Solve(problem), std::logic_error);
  problem = Plane(1.0, 1.0);
  problem.limit = 0.0;
  EXPECT_THROW(Solve(problem), std::logic_error);
  problem = Plane(1.0, 1.0);
  problem.group.pop_back();
  EXPECT_THROW(Solve(problem), std::logic_error);
  problem.a.resize(2, 0);
  problem.group.clear();
  EXPECT_EQ(Solve(problem).size(), 0);
}

}  // namespace
}  // namespace antigrasp
