#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "antigrasp/core/rng.h"
#include "antigrasp/core/statistics.h"

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

TEST(DiscretePercentile, IsAValueOfTheSampleNeverOneBetween) {
  // Interpolated, 75 % of 0.1, 0.2, 0.4, 0.7 were 0.475.
  EXPECT_EQ(DiscretePercentile({0.4, 1.6, 0.1, 0.7, 0.2}, 75.0), 0.7);
  EXPECT_EQ(DiscretePercentile({0.4, 1.6, 0.1, 0.7, 0.2}, 25.0), 0.2);
  EXPECT_EQ(DiscretePercentile({0.4, 0.1, 0.7, 0.2}, 75.0), 0.4);
  EXPECT_EQ(DiscretePercentile({0.4, 0.1, 0.7, 0.2}, 75.001), 0.7);
  EXPECT_EQ(DiscretePercentile({0.4, 0.1, 0.7, 0.2}, 50.0), 0.2);
}

TEST(DiscretePercentile, EndsAreTheSmallestAndTheLargest) {
  EXPECT_EQ(DiscretePercentile(Count(10), 0.0), 1.0);
  EXPECT_EQ(DiscretePercentile(Count(10), 100.0), 10.0);
  EXPECT_EQ(DiscretePercentile({7.0}, 75.0), 7.0);
}

TEST(DiscretePercentile, OfAnEmptySampleIsABug) {
  EXPECT_THROW(DiscretePercentile({}, 75.0), std::logic_error);
}

TEST(BootstrapPercentile, MatchesTheNormalApproximationOfTheBinomial) {
  const Interval interval = BootstrapPercentile(Count(100), 75.0);
  EXPECT_NEAR(interval.low, 75.0 - 1.96 * 4.33, 1.1);
  EXPECT_NEAR(interval.high, 75.0 + 1.96 * 4.33, 1.1);
}

TEST(BootstrapPercentileDifference, WeighsEveryPairByItsChance) {
  // The larger of two draws from {1, 2} is 1 with probability 1/4, else 2; from {10, 40} alike. The
  // differences -39, -38, -9, -8 have 3/16, 9/16, 1/16, 3/16: 2.5 % lie in the first, 97.5 % in the
  // last.
  const Interval interval = BootstrapPercentileDifference({2.0, 1.0}, {10.0, 40.0}, 100.0);
  EXPECT_EQ(interval.low, -39.0);
  EXPECT_EQ(interval.high, -8.0);
  const Interval turned = BootstrapPercentileDifference({10.0, 40.0}, {2.0, 1.0}, 100.0);
  EXPECT_EQ(turned.low, 8.0);
  EXPECT_EQ(turned.high, 39.0);
}

TEST(BootstrapPercentileDifference, FromOneSureValueIsTheIntervalOfTheOther) {
  const Interval own = BootstrapPercentile(Count(400), 75.0);
  const Interval interval = BootstrapPercentileDifference(Count(400), {100.0}, 75.0);
  EXPECT_EQ(interval.low, own.low - 100.0);
  EXPECT_EQ(interval.high, own.high - 100.0);
}

TEST(BootstrapPercentileDifference, OfTwoAlikeIsTheRootOfTwoAsWide) {
  // The percentile of 1, 2, ..., n deviates by sqrt(n 0.75 0.25), 13.7.
  const Interval interval = BootstrapPercentileDifference(Count(1000), Count(1000), 75.0);
  EXPECT_NEAR(interval.high, 1.96 * 13.7 * std::sqrt(2.0), 1.5);
  EXPECT_NEAR(interval.low, -interval.high, 1.5);
}

TEST(BootstrapPercentile, IsTheBinomialTailOnAHandfulOfValues) {
  // The larger of two is at most the first value with probability 1/4, the smaller with 3/4.
  EXPECT_EQ(BootstrapPercentile({1.0, 2.0}, 100.0).low, 1.0);
  EXPECT_EQ(BootstrapPercentile({1.0, 2.0}, 50.0).high, 2.0);
  // The largest of six is below the fourth with probability (3/6)^6 = 0.016, at most it with
  // (4/6)^6 = 0.088.
  EXPECT_EQ(BootstrapPercentile(Count(6), 100.0).low, 4.0);
  // The smallest of six is above the second with (4/6)^6 = 0.088, above the third with 0.016.
  EXPECT_EQ(BootstrapPercentile(Count(6), 0.0).high, 3.0);
  EXPECT_EQ(BootstrapPercentile(Count(6), 0.0).low, 1.0);
  // A tail of 2.5 %, not 5 %: the largest of four is at most the second with (1/2)^4 = 0.0625, the
  // first with 0.0039; of five the second has (2/5)^5 = 0.010, the third 0.078; of nine the sixth
  // has (6/9)^9 = 0.0260, the fifth 0.0050.
  EXPECT_EQ(BootstrapPercentile(Count(4), 100.0).low, 2.0);
  EXPECT_EQ(BootstrapPercentile(Count(5), 100.0).low, 3.0);
  EXPECT_EQ(BootstrapPercentile(Count(9), 100.0).low, 6.0);
  EXPECT_EQ(BootstrapPercentile({}, 75.0).high, 0.0);
}

TEST(BootstrapPercentile, AgreesWithResampling) {
  const std::vector<double> values = Count(40);
  const int resamples = 40000;
  std::vector<double> estimates;
  RngStream rng(1, "bootstrap");
  for (int i = 0; i < resamples; ++i) {
    std::vector<double> drawn;
    for (std::size_t k = 0; k < values.size(); ++k) drawn.push_back(values[rng.Below(40)]);
    estimates.push_back(DiscretePercentile(drawn, 60.0));
  }
  const Interval interval = BootstrapPercentile(values, 60.0);
  EXPECT_EQ(interval.low, DiscretePercentile(estimates, 2.5));
  EXPECT_EQ(interval.high, DiscretePercentile(estimates, 97.5));
}

TEST(BootstrapPercentile, CollapsesWithoutSpread) {
  const Interval same = BootstrapPercentile({2.0, 2.0, 2.0}, 75.0);
  EXPECT_EQ(same.low, 2.0);
  EXPECT_EQ(same.high, 2.0);
  EXPECT_EQ(BootstrapPercentile({5.0}, 75.0).high, 5.0);
}

TEST(MeanWithInterval, MatchesTheFormulaOnAKnownSample) {
  const MeanInterval m = MeanWithInterval({1.0, 2.0, 3.0, 4.0});
  EXPECT_EQ(m.count, 4);
  EXPECT_DOUBLE_EQ(m.mean, 2.5);
  EXPECT_NEAR(m.half_width, 1.96 * std::sqrt(5.0 / 3.0 / 4.0), 1e-14);
}

TEST(MeanText, LeavesOutAnIntervalThatDoesNotExist) {
  EXPECT_EQ(MeanText({0.72, 0.0549, 9}, 2), "0.72 +-0.05");
  EXPECT_EQ(MeanText(MeanWithInterval({0.25}), 3), "0.250");
  EXPECT_EQ(MeanText(MeanWithInterval({}), 2), "-");
}

TEST(MeanWithInterval, LeavesOutWhatCouldNotBeEvaluated) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const MeanInterval m = MeanWithInterval({nan, 1.0, nan, 3.0});
  EXPECT_EQ(m.count, 2);
  EXPECT_DOUBLE_EQ(m.mean, 2.0);
  EXPECT_NEAR(m.half_width, 1.96, 1e-15);  // variance 2, of the mean of two 1
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
