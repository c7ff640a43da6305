#include "antigrasp/perturb/cone.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
constexpr double kQuarter = std::numbers::pi / 4;

TEST(Cone, HoldsWhatIsWithinItsAngleAndNotTheOrigin) {
  const Cone cone(Vector3d::UnitZ(), kQuarter);
  EXPECT_TRUE(cone.Contains({1, 0, 1}));  // the rim
  EXPECT_TRUE(cone.Contains({0.999, 0, 1}));
  EXPECT_FALSE(cone.Contains({1.001, 0, 1}));
  EXPECT_FALSE(cone.Contains({0, 0, -1}));
  EXPECT_FALSE(cone.Contains({0, 0, 0}));
}

TEST(Cone, CutsALineWhereTheSurfaceIs) {
  const Cone cone(Vector3d::UnitZ(), kQuarter);
  const Range everywhere{-100, 100};
  // Across at height 2: |x| <= 2.
  const Range across = ClipToCone({-5, 0, 2}, {1, 0, 0}, cone, everywhere);
  EXPECT_NEAR(across.low, 3, 1e-9);
  EXPECT_NEAR(across.high, 7, 1e-9);
  // Straight up at x = 1: from height 1 on.
  const Range up = ClipToCone({1, 0, 0}, {0, 0, 1}, cone, everywhere);
  EXPECT_NEAR(up.low, 1, 1e-9);
  EXPECT_EQ(up.high, 100);
  const Range down = ClipToCone({1, 0, 0}, {0, 0, -1}, cone, everywhere);
  EXPECT_NEAR(down.high, -1, 1e-9);
  // Across below the apex: only the mirrored cone is met.
  EXPECT_TRUE(ClipToCone({-5, 0, -2}, {1, 0, 0}, cone, everywhere).empty());
  EXPECT_TRUE(ClipToCone({-5, 3, 2}, {1, 0, 0}, cone, everywhere).empty());
  // A point.
  EXPECT_FALSE(ClipToCone({0, 0, 1}, {0, 0, 0}, cone, everywhere).empty());
  EXPECT_TRUE(ClipToCone({2, 0, 1}, {0, 0, 0}, cone, everywhere).empty());
}

TEST(Cone, AgreesWithSamplesOfRandomLines) {
  RngStream rng(1, "cone_test");
  for (int i = 0; i < 2000; ++i) {
    const auto draw = [&] { return Vector3d(rng.Normal(), rng.Normal(), rng.Normal()); };
    const Cone cone(draw().normalized(), rng.Uniform(0.01, 1.5));
    const Vector3d start = draw(), step = draw();
    const Range range = ClipToCone(start, step, cone, {-3, 3});
    for (double s = -3; s <= 3; s += 0.1) {
      const bool inside = !range.empty() && s >= range.low && s <= range.high;
      const Vector3d at = start + s * step;
      const double angle = std::atan2(at.cross(cone.axis).norm(), at.dot(cone.axis));
      if (std::abs(angle - std::acos(cone.cosine)) < 1e-6) continue;
      EXPECT_EQ(inside, cone.Contains(at)) << i << " " << s;
    }
  }
}

}  // namespace
}  // namespace antigrasp
