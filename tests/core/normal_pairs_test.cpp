#include "antigrasp/core/normal_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

constexpr double kStep = 0x1p-53;  // of uniform numbers

// How many of BoxMuller's numbers differ from the library's in a bit.
int OtherBits(const std::vector<double>& uniform) {
  const std::size_t pairs = uniform.size() / 2;
  std::vector<double> normal(2 * pairs);
  BoxMuller(uniform.data(), static_cast<int>(pairs), normal.data());
  int other = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform[2 * i]));
    const double angle = 2.0 * std::numbers::pi * uniform[2 * i + 1];
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
    other += bits(normal[2 * i]) != bits(radius * std::cos(angle));
    other += bits(normal[2 * i + 1]) != bits(radius * std::sin(angle));
  }
  return other;
}

TEST(BoxMuller, GivesTheLibrarysBitsOfUsualNumbers) {
  RngStream rng(1, "pairs");
  std::vector<double> uniform(200'000);
  for (double& u : uniform) u = rng.Uniform();
  EXPECT_EQ(OtherBits(uniform), 0);
}

// Both ends of [0, 1), where the logarithm is nought or largest and the sine is nought, and the
// borders of the intervals that logarithm and turns are cut into.
TEST(BoxMuller, GivesTheLibrarysBitsAtEndsAndBorders) {
  std::vector<double> numbers;
  for (int power = 0; power <= 53; ++power) {
    for (int i = -3; i <= 3; ++i) {
      const double near = std::ldexp(1.0, -power) + i * kStep;
      numbers.push_back(near);
      numbers.push_back(1.0 - near);
    }
  }
  for (int border = 0; border <= 256; ++border) {
    for (const double off : {-1.0, 0.0, 1.0, 2.0, 1e3, -1e5, 1e8}) {
      numbers.push_back(border / 256.0 + off * kStep);
      numbers.push_back((border + 0.5) / 64.0 + off * kStep);
    }
  }
  std::erase_if(numbers, [](double u) { return !(u >= 0.0 && u < 1.0); });
  std::vector<double> uniform;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (const std::size_t other : {i, numbers.size() - 1 - i}) {
      uniform.insert(uniform.end(), {numbers[i], numbers[other]});
    }
  }
  ASSERT_GT(uniform.size(), 10'000U);
  EXPECT_EQ(OtherBits(uniform), 0);
}

TEST(BoxMuller, WritesAsManyPairsAsAskedFor) {
  std::vector<double> uniform(2 * 70, 0.25), normal(2 * 70, -7.0);
  BoxMuller(uniform.data(), 33, normal.data());
  EXPECT_EQ(std::count(normal.begin(), normal.begin() + 66, -7.0), 0);
  EXPECT_EQ(std::count(normal.begin() + 66, normal.end(), -7.0), 74);
}

TEST(PhiloxUniforms, AreThoseOfEachBlockAndCarryIntoTheSecondWord) {
  const std::array<std::uint32_t, 4> counter{0xfffffffd, 7, 11, 13};
  const std::array<std::uint32_t, 2> key{0xdeadbeef, 3};
  std::vector<double> uniform(2 * 40);
  PhiloxUniforms(counter, key, 40, uniform.data());
  for (std::uint32_t i = 0; i < 40; ++i) {
    const auto block = Philox({counter[0] + i, i < 3 ? 7u : 8u, 11, 13}, key);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint64_t word = block[2 * k] | static_cast<std::uint64_t>(block[2 * k + 1]) << 32;
      EXPECT_EQ(uniform[2 * i + k], static_cast<double>(word >> 11) * kStep) << i << " " << k;
    }
  }
}

TEST(RngStream, ManyNormalsAreThoseOfAsManyCallsWhereverTheStreamStands) {
  for (int before = 0; before < 4; ++before) {  // nothing, a word, two, half a pair
    for (const std::size_t count : {0, 1, 2, 3, 13, 64, 129, 325}) {
      RngStream one(5, "many", 1), many(5, "many", 1);
      for (RngStream* rng : {&one, &many}) {
        if (before == 1) rng->NextU32();
        if (before == 2) rng->NextU64();
        if (before == 3) rng->Normal();
      }
      std::vector<double> expected(count), found(count);
      for (double& x : expected) x = one.Normal();
      many.Normals(found);
      EXPECT_EQ(found, expected) << before << " " << count;
      EXPECT_EQ(many.Normal(), one.Normal());  // and the stream goes on as it would
      EXPECT_EQ(many.NextU64(), one.NextU64());
    }
  }
}

}  // namespace
}  // namespace antigrasp
