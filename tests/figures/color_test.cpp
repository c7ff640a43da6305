#include "antigrasp/figures/color.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antigrasp {
namespace {

bool Same(const Color& a, const Color& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a;
}

TEST(Color, ReliabilityRunsFromRedToGreenLinearlyAndIsCutAtItsEnds) {
  const Color worst = ReliabilityColor(0.0), best = ReliabilityColor(1.0);
  EXPECT_GT(worst.r, 0.8);
  EXPECT_LT(worst.g, 0.2);
  EXPECT_GT(best.g, 0.6);
  EXPECT_LT(best.r, 0.2);
  const Color middle = ReliabilityColor(0.5);
  EXPECT_NEAR(middle.r, 0.5 * (worst.r + best.r), 1e-12);
  EXPECT_NEAR(middle.g, 0.5 * (worst.g + best.g), 1e-12);
  EXPECT_TRUE(Same(ReliabilityColor(-3.0), worst));
  EXPECT_TRUE(Same(ReliabilityColor(7.0), best));
}

TEST(Color, SignedDistancesAreBlueOutsideOrangeInsideAndPaleAtTheSurface) {
  EXPECT_GT(SignedColor(-1.0).b, SignedColor(-1.0).r);
  EXPECT_GT(SignedColor(1.0).r, SignedColor(1.0).b);
  EXPECT_GT(SignedColor(0.0).r + SignedColor(0.0).g + SignedColor(0.0).b, 2.8);
}

TEST(Color, NoNumberIsGrey) {
  for (const Color& c : {ReliabilityColor(std::nan("")), SignedColor(std::nan(""))}) {
    EXPECT_EQ(c.r, c.g);
    EXPECT_EQ(c.g, c.b);
  }
}

}  // namespace
}  // namespace antigrasp
