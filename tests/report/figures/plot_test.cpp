#include "antigrasp/report/figures/plot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antigrasp {
namespace {

TEST(Ticks, AreRoundNumbersInsideTheRange) {
  const std::vector<double> ticks = Ticks(0.0, 1.4, 7);
  ASSERT_EQ(ticks.size(), 8u);
  EXPECT_EQ(ticks.front(), 0.0);
  EXPECT_NEAR(ticks[1], 0.2, 1e-12);
  EXPECT_NEAR(ticks.back(), 1.4, 1e-12);
  EXPECT_EQ(Ticks(-3.0, 47.0, 5), (std::vector<double>{0.0, 10.0, 20.0, 30.0, 40.0}));
}

TEST(Ticks, OfNoRangeAreNone) {
  EXPECT_TRUE(Ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(Ticks(0.0, std::nan(""), 5).empty());
  EXPECT_TRUE(Ticks(0.0, INFINITY, 5).empty());
}

TEST(Ticks, AnAxisIsRoundedUpToEndAtOne) {
  EXPECT_EQ(RoundUp(0.0, 47.0, 5), 50.0);
  EXPECT_EQ(RoundUp(0.0, 50.0, 5), 50.0);
  EXPECT_NEAR(RoundUp(0.0, 1.31, 5), 1.4, 1e-12);
}

TEST(Plot, PutsTheRangesAtTheCornersOfItsArea) {
  const Plot plot(nullptr, {10.0, 20.0, 100.0, 50.0}, {0.0, 2.0, ""}, {-1.0, 1.0, ""});
  EXPECT_EQ(plot.At(0.0, -1.0).x, 10.0);
  EXPECT_EQ(plot.At(0.0, -1.0).y, 70.0);
  EXPECT_EQ(plot.At(2.0, 1.0).x, 110.0);
  EXPECT_EQ(plot.At(2.0, 1.0).y, 20.0);
  EXPECT_EQ(plot.At(1.0, 0.0).x, 60.0);
}

}  // namespace
}  // namespace antigrasp
