#include "antigrasp/train/elites.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace antigrasp {
namespace {

using Indices = std::vector<std::int64_t>;
const double kNaN = std::nan("");

TEST(LeastGraspable, KeepsTheLowestAndBreaksTiesByIndex) {
  EXPECT_EQ(LeastGraspable({0.3, 0.1, 0.2, 0.1, 0.1}, 3), (Indices{1, 3, 4}));
  EXPECT_EQ(LeastGraspable({0.3, 0.1, 0.2, 0.1, 0.1}, 2), (Indices{1, 3}));
}

TEST(LeastGraspable, NeverKeepsARejectedObject) {
  EXPECT_EQ(LeastGraspable({kNaN, 0.5, kNaN, 0.4}, 3), (Indices{1, 3}));
  EXPECT_TRUE(LeastGraspable({kNaN, kNaN}, 3).empty());
}

TEST(RandomKeep, DrawsDistinctValidObjectsUniformly) {
  const std::vector<double> values = {0.1, kNaN, 0.2, 0.3, kNaN, 0.4, 0.5};
  std::vector<int> counts(values.size());
  for (std::uint64_t stage = 0; stage < 3000; ++stage) {
    const Indices kept = RandomKeep(values, 2, 1, stage);
    ASSERT_EQ(std::set<std::int64_t>(kept.begin(), kept.end()).size(), 2U);
    for (const std::int64_t i : kept) ++counts[static_cast<std::size_t>(i)];
  }
  EXPECT_EQ(counts[1] + counts[4], 0);
  for (const std::size_t i : {0, 2, 3, 5, 6}) EXPECT_NEAR(counts[i], 1200, 140) << i;
}

TEST(RandomKeep, RepeatsForTheSameSeedAndStage) {
  const std::vector<double> values(50, 0.1);
  EXPECT_EQ(RandomKeep(values, 10, 4, 2), RandomKeep(values, 10, 4, 2));
  EXPECT_NE(RandomKeep(values, 10, 4, 2), RandomKeep(values, 10, 5, 2));
}

}  // namespace
}  // namespace antigrasp
