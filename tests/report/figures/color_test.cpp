#include "antigrasp/report/figures/color.h"

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

TEST(Color, TheEndsAndTheMiddlesHaveTheirNumbers) {
  const auto near = [](const Color& c, double r, double g, double b) {
    return std::abs(c.r - r) + std::abs(c.g - g) + std::abs(c.b - b) < 1e-12 && c.a == 1.0;
  };
  EXPECT_TRUE(near(ReliabilityColor(0.0), 0.84, 0.10, 0.10));
  EXPECT_TRUE(near(ReliabilityColor(1.0), 0.10, 0.62, 0.20));
  EXPECT_TRUE(near(ReliabilityColor(0.25), 0.655, 0.23, 0.125));
  EXPECT_TRUE(near(SignedColor(-1.0), 0.13, 0.33, 0.62));
  EXPECT_TRUE(near(SignedColor(0.0), 0.97, 0.97, 0.97));
  EXPECT_TRUE(near(SignedColor(1.0), 0.80, 0.36, 0.05));
  EXPECT_TRUE(near(SignedColor(-0.25), 0.76, 0.81, 0.8825));
  EXPECT_TRUE(near(SignedColor(0.5), 0.885, 0.665, 0.51));
  EXPECT_TRUE(Same(SignedColor(-7.0), SignedColor(-1.0)));
  EXPECT_TRUE(Same(SignedColor(7.0), SignedColor(1.0)));
}

TEST(Color, NoNumberIsGrey) {
  for (const Color& c : {ReliabilityColor(std::nan("")), SignedColor(std::nan(""))}) {
    EXPECT_EQ(c.r, c.g);
    EXPECT_EQ(c.g, c.b);
  }
}

TEST(Color, DegreesGoFromLightToDark) {
  const auto lightness = [](double share) {
    const Color color = DegreeColor(share);
    return 0.3 * color.r + 0.6 * color.g + 0.1 * color.b;
  };
  for (int k = 0; k < 5; ++k) EXPECT_GT(lightness(0.2 * k), lightness(0.2 * (k + 1)) + 0.05) << k;
  EXPECT_EQ(DegreeColor(-1.0).g, DegreeColor(0.0).g);
  EXPECT_EQ(DegreeColor(std::nan("")).r, DegreeColor(std::nan("")).b);  // grey
}

}  // namespace
}  // namespace antigrasp
