#include "antigrasp/core/rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace antigrasp {
namespace {

TEST(Philox, GivesThePublishedKnownAnswers) {
  // Random123 1.14, tests/kat_vectors, philox4x32 10.
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(Philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(Philox({ones, ones, ones, ones}, {ones, ones}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RngStream, RepeatsForEqualWorkItemsAndDiffersForAnyOtherOne) {
  const auto first = [](RngStream rng) { return rng.NextU64(); };
  const std::uint64_t reference = first(RngStream(1, "grasp", 2, 3));
  EXPECT_EQ(first(RngStream(1, "grasp", 2, 3)), reference);
  std::set<std::uint64_t> seen = {reference};
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const char* domain : {"grasp", "noise"}) {
      for (std::uint64_t a = 0; a < 8; ++a) {
        for (std::uint64_t b = 0; b < 8; ++b) seen.insert(first(RngStream(seed, domain, a, b)));
      }
    }
  }
  EXPECT_EQ(seen.size(), 4U * 2 * 8 * 8);
}

TEST(RngStream, UniformHasTheMomentsOfTheUnitInterval) {
  RngStream rng(7, "moments");
  double sum = 0, square = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double u = rng.Uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    square += u * u;
  }
  EXPECT_NEAR(sum / kDraws, 0.5, 0.005);  // 5 standard errors
  EXPECT_NEAR(square / kDraws, 1.0 / 3, 0.005);
}

TEST(RngStream, NormalHasTheMomentsOfTheStandardNormal) {
  RngStream rng(7, "moments");
  double sum = 0, square = 0, fourth = 0;
  constexpr int kDraws = 100000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = rng.Normal();
    sum += x;
    square += x * x;
    fourth += x * x * x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.016);
  EXPECT_NEAR(square / kDraws, 1.0, 0.025);
  EXPECT_NEAR(fourth / kDraws, 3.0, 0.16);
}

TEST(RngStream, BelowIsUniformOverSmallRanges) {
  RngStream rng(3, "below");
  std::vector<int> counts(5);
  for (int i = 0; i < 50000; ++i) ++counts[rng.Below(5)];
  for (const int count : counts) EXPECT_NEAR(count, 10000, 450);
}

}  // namespace
}  // namespace antigrasp
