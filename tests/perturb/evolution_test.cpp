#include "antigrasp/perturb/evolution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antigrasp {
namespace {

using Eigen::VectorXd;

// Minimum 0 at (1, 2, ..., n), 1000 times as steep in the last direction as in the first, turned
// so that no axis is a coordinate's.
double Valley(const VectorXd& x) {
  const auto n = x.size();
  VectorXd d(n);
  for (Eigen::Index i = 0; i < n; ++i) d[i] = x[i] - static_cast<double>(i + 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    const double a = 0.6 * d[i] + 0.8 * d[i + 1], b = -0.8 * d[i] + 0.6 * d[i + 1];
    d[i] = a;
    d[i + 1] = b;
  }
  double sum = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    sum += std::pow(1000.0, static_cast<double>(i) / static_cast<double>(n - 1)) * d[i] * d[i];
  }
  return sum;
}

VectorXd Found(int generations, std::uint64_t seed, double (*order)(double)) {
  CmaEs evolution(VectorXd::Zero(6), 0.5);
  RngStream rng(seed, "evolution-test");
  for (int i = 0; i < generations; ++i) {
    const Eigen::MatrixXd samples = evolution.Ask(&rng);
    std::vector<double> values;
    for (Eigen::Index k = 0; k < samples.cols(); ++k)
      values.push_back(order(Valley(samples.col(k))));
    evolution.Tell(values);
  }
  return evolution.mean();
}

double Same(double value) { return value; }
double Logarithm(double value) { return std::log(1e-300 + value); }

TEST(CmaEs, FindsTheBottomOfATurnedValley) {
  const VectorXd found = Found(300, 4, Same);
  for (Eigen::Index i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], double(i + 1), 1e-5) << i;
}

TEST(CmaEs, LooksAtTheOrderOfTheValuesAlone) {
  EXPECT_EQ(Found(60, 4, Same), Found(60, 4, Logarithm));
  EXPECT_NE(Found(60, 4, Same), Found(60, 5, Same));
}

TEST(CmaEs, TakesTheSizeOfItsGenerationsFromTheTutorial) {
  EXPECT_EQ(CmaEs(VectorXd::Zero(6), 0.5).population(), 9);  // 4 + floor(3 ln 6)
  EXPECT_EQ(CmaEs(VectorXd::Zero(36), 0.5).population(), 14);
  EXPECT_EQ(CmaEs(VectorXd::Zero(36), 0.5, 7).population(), 7);
}

}  // namespace
}  // namespace antigrasp
