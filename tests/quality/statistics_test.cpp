#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "antigrasp/quality/bootstrap.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {
namespace {

std::vector<double> Count(int n) {  // n, ..., 2, 1
  std::vector<double> values;
  for (int i = n; i >= 1; --i) values.push_back(i);
  return values;
}

TEST(DiscretePercentile, IsTheSmallestValueWithThatShareAtOrBelow) {
  EXPECT_EQ(DiscretePercentile(Count(100), 75.0), 75.0);
  EXPECT_EQ(DiscretePercentile(Count(100), 75.1), 76.0);
  EXPECT_EQ(DiscretePercentile(Count(4), 75.0), 3.0);
  EXPECT_EQ(DiscretePercentile(Count(5), 75.0), 4.0);
  EXPECT_EQ(DiscretePercentile(Count(3), 50.0), 2.0);
}

TEST(DiscretePercentile, EndsAreTheSmallestAndTheLargest) {
  EXPECT_EQ(DiscretePercentile(Count(10), 0.0), 1.0);
  EXPECT_EQ(DiscretePercentile(Count(10), 100.0), 10.0);
  EXPECT_EQ(DiscretePercentile({7.0}, 75.0), 7.0);
}

TEST(DiscretePercentile, OfAnEmptySampleIsABug) {
  EXPECT_THROW(DiscretePercentile({}, 75.0), std::logic_error);
}

TEST(BootstrapPercentile, EndsMatchTheBinomialDistribution) {
  // The k-th smallest of a resample of n is <= x_(i) when Binomial(n, i/n) >= k. For n = 100 and
  // k = 75 its standard deviation is sqrt(100 * 0.75 * 0.25) = 4.33 ranks.
  RngStream rng(1, "bootstrap");
  const Interval interval = BootstrapPercentile(Count(100), 75.0, 20000, &rng);
  EXPECT_NEAR(interval.low, 75.0 - 1.96 * 4.33, 1.1);
  EXPECT_NEAR(interval.high, 75.0 + 1.96 * 4.33, 1.1);
}

TEST(BootstrapPercentile, ContainsTheEstimateAndIsReproducible) {
  RngStream rng(2, "bootstrap"), again(2, "bootstrap");
  const Interval a = BootstrapPercentile(Count(30), 75.0, 1000, &rng);
  const Interval b = BootstrapPercentile(Count(30), 75.0, 1000, &again);
  EXPECT_LE(a.low, 23.0);
  EXPECT_GE(a.high, 23.0);
  EXPECT_EQ(a.low, b.low);
  EXPECT_EQ(a.high, b.high);
}

TEST(BootstrapPercentile, CollapsesWithoutResamplesOrSpread) {
  RngStream rng(3, "bootstrap");
  EXPECT_EQ(BootstrapPercentile(Count(4), 75.0, 0, &rng).low, 3.0);
  EXPECT_EQ(BootstrapPercentile(Count(4), 75.0, 0, &rng).high, 3.0);
  const Interval same = BootstrapPercentile({2.0, 2.0, 2.0}, 75.0, 100, &rng);
  EXPECT_EQ(same.low, 2.0);
  EXPECT_EQ(same.high, 2.0);
}

TEST(MeanWithInterval, MatchesTheFormulaOnAKnownSample) {
  const MeanInterval m = MeanWithInterval({1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(m.count, 4);
  EXPECT_DOUBLE_EQ(m.mean, 2.5);
  EXPECT_NEAR(m.half_width, 1.96 * std::sqrt(5.0 / 3.0 / 4.0), 1e-14);
}

TEST(MeanWithInterval, LeavesOutWhatCouldNotBeEvaluated) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const MeanInterval m = MeanWithInterval({nan, 1.0, nan, 3.0});
  EXPECT_EQ(m.count, 2);
  EXPECT_DOUBLE_EQ(m.mean, 2.0);
}

TEST(MeanWithInterval, SaysNothingAboutNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(MeanWithInterval({}).count, 0);
  EXPECT_TRUE(std::isnan(MeanWithInterval({nan}).mean));
  EXPECT_EQ(MeanWithInterval({5.0}).mean, 5.0);
  EXPECT_TRUE(std::isnan(MeanWithInterval({5.0}).half_width));
}

}  // namespace
}  // namespace antigrasp
