#include "antigrasp/datasets/bottle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace antigrasp {
namespace {

TEST(Bottle, CylinderProfileHasTheCylindersDistances) {
  const BottleProfile can{{{0, -0.5}, {0.2, -0.5}, {0.2, 0.5}, {0, 0.5}}};
  EXPECT_DOUBLE_EQ(SignedDistance(can, 0.0, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(SignedDistance(can, 0.0, 0.45), 0.05);  // the axis is no surface
  EXPECT_DOUBLE_EQ(SignedDistance(can, 0.5, 0.0), -0.3);
  EXPECT_DOUBLE_EQ(SignedDistance(can, 0.5, 0.9), -0.5);
}

TEST(Bottle, ConeProfileHasTheConesDistances) {
  const BottleProfile cone{{{0, 0}, {0.3, 0}, {0, 0.4}}};
  EXPECT_NEAR(SignedDistance(cone, 0.0, 0.15), 0.15, 1e-15);  // base and wall are equally near
  EXPECT_NEAR(SignedDistance(cone, 0.3, 0.4), -0.24, 1e-15);
}

TEST(Bottle, EveryFamilyFitsTheDesignCubeAndIsCentred) {
  for (int family = 0; family < kBottleFamilies; ++family) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      RngStream rng(seed, "bottle-test");
      const BottleProfile bottle = SampleBottle(family, rng);
      double low = 1.0, high = -1.0, widest = 0.0;
      for (const auto& p : bottle.outline) {
        EXPECT_GE(p.x(), 0.0);
        widest = std::max(widest, p.x());
        low = std::min(low, p.y());
        high = std::max(high, p.y());
      }
      EXPECT_NEAR(low + high, 0.0, 1e-12);
      EXPECT_LE(high, 0.5);
      EXPECT_LE(widest, 0.45);
      EXPECT_EQ(bottle.outline.front().x(), 0.0);
      EXPECT_EQ(bottle.outline.back().x(), 0.0);
    }
  }
}

TEST(Bottle, OutlineNeverCrossesItself) {
  const auto side = [](const auto& a, const auto& b, const auto& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  for (int family = 0; family < kBottleFamilies; ++family) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      RngStream rng(seed, "bottle-test");
      const auto outline = SampleBottle(family, rng).outline;
      for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        for (std::size_t j = i + 2; j + 1 < outline.size(); ++j) {
          const auto &a = outline[i], &b = outline[i + 1], &c = outline[j], &d = outline[j + 1];
          EXPECT_FALSE(side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0)
              << "family " << family << " seed " << seed;
        }
      }
    }
  }
}

// Index of the point where the cap's wall begins; the neck ends at the one before.
std::size_t CapRim(const std::vector<Eigen::Vector2d>& outline) {
  std::size_t rim = outline.size() - 1;
  while (outline[rim].y() == outline.back().y() || outline[rim].y() != outline[rim - 1].y()) --rim;
  return rim;
}

TEST(Bottle, CapsAreTwoCellsThickAndRoundedAbove) {
  for (int family = 0; family < kBottleFamilies; ++family) {
    for (int seed = 0; seed < 20; ++seed) {
      RngStream rng(seed, "bottle-test");
      const BottleProfile bottle = SampleBottle(family, rng);
      const auto& outline = bottle.outline;
      const double top = outline.back().y();
      const std::size_t rim = CapRim(outline);
      const double radius = outline[rim].x();
      EXPECT_GE(top - outline[rim].y(), 2.0 / 32) << "family " << family;
      EXPECT_GT(SignedDistance(bottle, 0.98 * radius, outline[rim].y() + 0.01), 0.0);
      EXPECT_LT(SignedDistance(bottle, radius, top), -0.004) << "family " << family;
    }
  }
}

TEST(Bottle, NeckIsNarrowerThanTheBody) {
  for (int family = 0; family < kBottleFamilies; ++family) {
    RngStream rng(5, "bottle-test");
    const auto outline = SampleBottle(family, rng).outline;
    double body = 0.0;
    for (const auto& p : outline) body = std::max(body, p.x());
    const double neck = outline[CapRim(outline) - 1].x();
    EXPECT_LT(neck, 0.9 * body) << "family " << family;
    EXPECT_GT(neck, 0.03) << "family " << family;
  }
}

}  // namespace
}  // namespace antigrasp
