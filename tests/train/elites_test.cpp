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

// Objects on a line: their distances are differences.
DistanceMatrix OnALine(const std::vector<float>& at) {
  const auto n = static_cast<Eigen::Index>(at.size());
  DistanceMatrix distances(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      distances(i, j) = std::abs(at[static_cast<std::size_t>(i)] - at[static_cast<std::size_t>(j)]);
    }
  }
  return distances;
}

// Two heaps, 0 to 0.3 and 10 to 10.2: the least graspable of all lie in the first.
TEST(DominatedNovelty, KeepsTheLeastGraspableAndWhatIsUnlikeAllThatBeatIt) {
  const std::vector<double> values = {0.1, 0.2, 0.3, 0.4, 0.7, 0.6, 0.8};
  const DistanceMatrix distances = OnALine({0.0F, 0.1F, 0.2F, 0.3F, 10.0F, 10.1F, 10.2F});
  // Worth, one neighbour: endless, .1, .1, .1, .1 (to the one at 10.1), 9.8 (to that at .3), .1
  EXPECT_EQ(DominatedNovelty(values, distances, 2, 1), (Indices{0, 5}));
  EXPECT_EQ(DominatedNovelty(values, distances, 1, 1), (Indices{0}));
  // Three neighbours: .1, .15, .2 within the first heap; (.1 + 9.7 + 9.8) / 3 = 6.5 for the fifth,
  // (9.8 + 9.9 + 10) / 3 for the sixth, (.1 + .2 + 9.9) / 3 = 3.4 for the last.
  EXPECT_EQ(DominatedNovelty(values, distances, 3, 3), (Indices{0, 4, 5}));
  EXPECT_EQ(DominatedNovelty(values, distances, 4, 3), (Indices{0, 4, 5, 6}));
  EXPECT_EQ(DominatedNovelty(values, distances, 5, 3), (Indices{0, 3, 4, 5, 6}));
}

TEST(DominatedNovelty, NeverKeepsARejectedObjectAndComparesWithNone) {
  const std::vector<double> values = {kNaN, 0.2, 0.1};
  const DistanceMatrix distances = OnALine({0.0F, 1.0F, 3.0F});
  EXPECT_EQ(DominatedNovelty(values, distances, 3, 1), (Indices{1, 2}));
  EXPECT_EQ(DominatedNovelty(values, distances, 1, 1), (Indices{2}));
  EXPECT_TRUE(DominatedNovelty({kNaN}, OnALine({0.0F}), 1, 1).empty());
}

// Of two that are equally graspable the first one beats the second, not both each other.
TEST(DominatedNovelty, OfEqualsTheLowerIndexBeatsTheOther) {
  const DistanceMatrix distances = OnALine({0.0F, 0.0F, 5.0F});
  EXPECT_EQ(DominatedNovelty({0.1, 0.1, 0.2}, distances, 2, 1), (Indices{0, 2}));
}

}  // namespace
}  // namespace antigrasp
