#include "antigrasp/core/rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>
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

TEST(HashOf, GivesThePublishedAnswersOfFnv1a) {
  // draft-eastlake-fnv, 64-bit FNV-1a.
  EXPECT_EQ(HashOf(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(HashOf("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(HashOf("foobar"), 0x85944171f73967e8ULL);
  EXPECT_NE(HashOf("\xc3\xa9"), HashOf("\xc3\xa8"));  // bytes above 127 count
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

// Saved sets, scores and checkpoints come from these numbers: they may never change.
TEST(RngStream, TheFirstWordsOfAWorkItemAreFixed) {
  using Words = std::array<std::uint32_t, 6>;  // the fifth begins the second block
  const auto first = [](RngStream rng) {
    Words words;
    for (auto& word : words) word = rng.NextU32();
    return words;
  };
  EXPECT_EQ(first({1, "grasp", 2, 3}),
            (Words{0xc4915257, 0x85b69b33, 0x1db8b5b2, 0xcf851bb8, 0xc3b4a163, 0x3d0d546c}));
  EXPECT_EQ(first({1, "grasp", 3, 2}),
            (Words{0xbf9e3f63, 0xa5214b1d, 0xc572b80c, 0x3244dc31, 0x27531ac8, 0xdbf84ad3}));
  EXPECT_EQ(first({1, "grasp"}),
            (Words{0xb9fd5694, 0x6e11a3d6, 0xd511385a, 0x1d4073e3, 0x897e14c9, 0xb7fb02b1}));
  EXPECT_EQ(first({1, "grasp", 0, 0}), first({1, "grasp"}));
  EXPECT_EQ(first({std::uint64_t{1} << 63, "noise", 7}),
            (Words{0x0fb40e4d, 0xff91a901, 0xc56e6143, 0xd13abdf0, 0x591c56dd, 0x50e484cb}));
}

// Each from the words of (1, "grasp", 2, 3) above.
TEST(RngStream, EveryKindOfNumberFollowsFromTheWords) {
  const RngStream start(1, "grasp", 2, 3);
  RngStream rng = start;
  EXPECT_EQ(rng.NextU64(), 0x85b69b33c4915257U);  // the low half comes first
  EXPECT_EQ(rng.NextU64(), 0xcf851bb81db8b5b2U);
  rng = start;
  EXPECT_EQ(rng.Uniform(), 0.5223176003824552);  // the upper 53 bits over 2^53
  EXPECT_EQ(rng.Uniform(), 0.8106248211385914);
  rng = start;
  EXPECT_EQ(rng.Uniform(-1.0, 3.0), -1.0 + 4.0 * 0.5223176003824552);
  rng = start;
  for (const std::uint64_t expected : {391U, 818U, 691U, 124U}) {
    EXPECT_EQ(rng.Below(1000), expected);
  }
  EXPECT_EQ(rng.Below(1), 0U);
  EXPECT_THROW(rng.Below(0), std::logic_error);
}

// Box-Muller: sqrt(-2 ln(1 - u)) times the cosine, then the sine, of 2 pi v.
TEST(RngStream, NormalsComeInPairsTheCosineFirst) {
  RngStream rng(1, "grasp", 2, 3);
  EXPECT_NEAR(rng.Normal(), 0.45191597115485077, 1e-15);
  EXPECT_NEAR(rng.Normal(), -1.1284459940823166, 1e-15);
  EXPECT_EQ(rng.NextU64(), 0x3d0d546cc3b4a163U);  // two uniforms made both
}

// n = 2^63 + 1: 2^64 mod n = 2^63 - 1, so a word below that is drawn again. The words begin 85..,
// cf.., 3d.., 3a.., 8c..; those kept lose n.
TEST(RngStream, BelowDrawsAgainWhereARemainderWouldBeLikelier) {
  RngStream rng(1, "grasp", 2, 3);
  const std::uint64_t n = (std::uint64_t{1} << 63) + 1;
  EXPECT_EQ(rng.Below(n), 0x05b69b33c4915256U);
  EXPECT_EQ(rng.Below(n), 0x4f851bb81db8b5b1U);
  EXPECT_EQ(rng.Below(n), 0x0c92bb0b9bd1cf38U);
}

}  // namespace
}  // namespace antigrasp
