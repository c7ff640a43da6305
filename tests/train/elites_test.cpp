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

TEST(RandomOrder, MakesTheLeastOfThemAUniformDrawOfValidObjects) {
  const std::vector<double> values = {0.1, kNaN, 0.2, 0.3, kNaN, 0.4, 0.5};
  std::vector<int> counts(values.size());
  for (std::uint64_t stage = 0; stage < 3000; ++stage) {
    RngStream rng(1, "control", stage);
    const Indices kept = LeastGraspable(RandomOrder(values, &rng), 2);
    ASSERT_EQ(std::set<std::int64_t>(kept.begin(), kept.end()).size(), 2U);
    for (const std::int64_t i : kept) ++counts[static_cast<std::size_t>(i)];
  }
  EXPECT_EQ(counts[1] + counts[4], 0);
  for (const std::size_t i : {0, 2, 3, 5, 6}) EXPECT_NEAR(counts[i], 1200, 140) << i;
}

TEST(RandomOrder, OfAnObjectDoesNotDependOnWhichOthersWereRejected) {
  RngStream whole(1, "control", 1), rejected(1, "control", 1), other(1, "control", 2);
  const std::vector<double> order = RandomOrder({0.1, 0.2, 0.3}, &whole);
  const std::vector<double> after = RandomOrder({kNaN, 0.9, 0.3}, &rejected);
  EXPECT_TRUE(std::isnan(after[0]));
  EXPECT_EQ(after[1], order[1]);
  EXPECT_EQ(after[2], order[2]);
  EXPECT_NE(RandomOrder({0.1, 0.2, 0.3}, &other), order);
}

TEST(LeastGraspableByCell, SharesTheElitesOutByWeightAndTakesTheLeastOfEachCell) {
  const std::vector<double> values = {0.1, 0.2, 0.3, 0.9, 0.8, 0.7};
  const Indices cell = {0, 0, 0, 1, 1, 1};
  const SharedElites equal = LeastGraspableByCell(values, cell, {1.0, 1.0}, 4);
  EXPECT_EQ(equal.elites, (Indices{0, 1, 4, 5}));  // though 0.7 and 0.8 are above 0.3
  EXPECT_EQ(equal.missing, (Indices{0, 0}));
  EXPECT_EQ(LeastGraspableByCell(values, cell, {3.0, 1.0}, 4).elites, (Indices{0, 1, 2, 5}));
}

TEST(LeastGraspableByCell, CountsWhatNoValidObjectFills) {
  const SharedElites shared =
      LeastGraspableByCell({0.1, kNaN, kNaN, 0.4}, {0, 1, 1, 0}, {1.0, 1.0, 2.0}, 8);
  EXPECT_EQ(shared.elites, (Indices{0, 3}));
  EXPECT_EQ(shared.missing, (Indices{0, 2, 4}));
}

TEST(LeastGraspableByCell, GivesSharesThatDoNotDivideToTheLargestRemainders) {
  const std::vector<double> values(12, 0.5);
  const Indices cell = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2};
  // 5 x (0.2, 0.3, 0.5) = (1, 1.5, 2.5): one each of the remainder would be six.
  const SharedElites shared = LeastGraspableByCell(values, cell, {2.0, 3.0, 5.0}, 5);
  EXPECT_EQ(shared.elites, (Indices{0, 4, 5, 8, 9}));
}

TEST(LeastGraspableByCell, RanksTheRemaindersAndNotTheShares) {
  const std::vector<double> values(9, 0.5);
  const Indices cell = {0, 0, 0, 1, 1, 1, 2, 2, 2};
  // 4 x (1, 2, 4) / 7 = (0.57, 1.14, 2.29): the one that is left goes to the smallest cell.
  EXPECT_EQ(LeastGraspableByCell(values, cell, {1.0, 2.0, 4.0}, 4).elites, (Indices{0, 3, 6, 7}));
  // 5 x (1, 2, 4) / 7 = (0.71, 1.43, 2.86): two are left, for the last cell and the first.
  EXPECT_EQ(LeastGraspableByCell(values, cell, {1.0, 2.0, 4.0}, 5).elites,
            (Indices{0, 3, 6, 7, 8}));
}

TEST(LeastGraspableByCell, WithOneCellIsTheRuleOfThePaper) {
  const std::vector<double> values = {0.3, kNaN, 0.1, 0.2, 0.5};
  EXPECT_EQ(LeastGraspableByCell(values, {0, 0, 0, 0, 0}, {7.0}, 3).elites,
            LeastGraspable(values, 3));
}

}  // namespace
}  // namespace antigrasp
