#include "antigrasp/similarity/set_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using Places = std::vector<double>;

// Shapes as places on a line: distances by hand.
DistanceMatrix Between(const Places& a, const Places& b) {
  DistanceMatrix matrix(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      matrix(Eigen::Index(i), Eigen::Index(j)) = static_cast<float>(std::abs(a[i] - b[j]));
    }
  }
  return matrix;
}

SetComparison Compare(const Places& samples, const Places& reference) {
  return CompareSets(Between(samples, samples), Between(samples, reference),
                     Between(reference, reference));
}
SpreadComparison Spreads(const Places& samples, const Places& reference) {
  return CompareSpreads(Between(samples, samples), Between(reference, reference));
}

TEST(CompareSets, OfThreeShapesIsByHand) {
  const SetComparison found = Compare({0, 1, 10}, {2, 12, 20});
  EXPECT_DOUBLE_EQ(found.coverage, 2.0 / 3);             // 2 twice, 12 once; 20 never
  EXPECT_DOUBLE_EQ(found.matching, (1 + 2 + 10) / 3.0);  // from 2 to 1, 12 to 10, 20 to 10
  EXPECT_DOUBLE_EQ(found.to_reference, (2 + 1 + 2) / 3.0);
  // Own is nearer: 0 (1 < 2), 20 (8 < 10). 1 has ties (1 = 1), which count against it.
  EXPECT_DOUBLE_EQ(found.nna, 2.0 / 6);
  EXPECT_DOUBLE_EQ(found.within_reference, (10 + 8 + 8) / 3.0);
}

TEST(CompareSpreads, OfThreeShapesIsByHand) {
  const SpreadComparison found = Spreads({0, 1, 10}, {2, 12, 20});
  EXPECT_DOUBLE_EQ(found.samples.mean_distance, (1 + 10 + 9) / 3.0);
  EXPECT_DOUBLE_EQ(found.median_distance, 10.0);
  EXPECT_DOUBLE_EQ(found.diversity, 20.0 / 36);
  // The reference's nearest are 10, 8, 8: nearer than 4 are the samples 0 and 1.
  EXPECT_DOUBLE_EQ(found.samples.duplicates, 2.0 / 3);
  EXPECT_DOUBLE_EQ(found.reference.duplicates, 0.0);
}

TEST(CompareSets, FindsThePermutedSetItself) {
  const SetComparison same = Compare({0, 1, 5, 9}, {9, 0, 5, 1});
  EXPECT_EQ(same.coverage, 1.0);
  EXPECT_EQ(same.matching, 0.0);
  EXPECT_EQ(same.to_reference, 0.0);
  EXPECT_EQ(same.nna, 0.0);
  EXPECT_EQ(Spreads({0, 1, 5, 9}, {9, 0, 5, 1}).diversity, 1.0);
}

TEST(CompareSets, SeesSetsApart) {
  const SetComparison apart = Compare({0, 1, 2, 3}, {100, 101, 102, 103});
  EXPECT_EQ(apart.nna, 1.0);
  EXPECT_EQ(apart.coverage, 0.25);
  EXPECT_NEAR(Spreads({0, 1, 2, 3}, {100, 101, 102, 103}).diversity, 1.0, 1e-12);
}

TEST(WithoutFloors, GivesBackTheDistancesBehindThem) {
  // Measured: sqrt(d^2 + f^2) with the mean floor of the pair.
  const DistanceMatrix exact = Between({0, 4, 12}, {0, 4, 12});
  const std::vector<double> floors = {1, 3, 5};
  DistanceMatrix measured = exact;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i != j) measured(i, j) = std::hypot(exact(i, j), float(floors[i] + floors[j]) / 2);
    }
  }
  EXPECT_LT((WithoutFloors(measured, floors) - exact).norm(), 1e-5F);
  EXPECT_EQ(WithoutFloors(measured, {100, 100, 100}).norm(), 0.0F);
  EXPECT_THROW(WithoutFloors(measured, {1, 1}), std::logic_error);
}

TEST(CompareSets, CannotTellTwoDrawsOfOneDistributionApart) {
  RngStream rng(1, "places");
  Places a, b;
  for (int i = 0; i < 600; ++i) {
    a.push_back(rng.Normal());
    b.push_back(rng.Normal());
  }
  const SetComparison similar = Compare(a, b);
  EXPECT_NEAR(similar.nna, 0.5, 0.06);
  EXPECT_NEAR(Spreads(a, b).diversity, 1.0, 0.1);
}

TEST(CompareSets, RefusesSetsOfOneShapeOrOfOtherSizes) {
  EXPECT_THROW(Compare({0}, {1}), std::logic_error);
  EXPECT_THROW(Compare({0, 1}, {1, 2, 3}), std::logic_error);
  EXPECT_THROW(Spreads({0}, {1, 2}), std::logic_error);
}

TEST(VendiScore, OfEqualShapesIsOne) {
  EXPECT_NEAR(VendiScore(Between(Places(7, 2.0), Places(7, 2.0)), 1.0), 1.0, 1e-9);
  EXPECT_NEAR(VendiScore(Between({5}, {5}), 0.0), 1.0, 1e-12);
}

TEST(VendiScore, CountsClustersFarApart) {
  Places places;
  for (int i = 0; i < 30; ++i) places.push_back(1000.0 * (i % 5) + 1e-3 * i);
  EXPECT_NEAR(VendiScore(Between(places, places), 1.0), 5.0, 1e-2);
  EXPECT_NEAR(VendiScore(Between({0, 100, 200}, {0, 100, 200}), 1.0), 3.0, 1e-9);
}

TEST(VendiScore, OfTwoShapesIsTheEntropyOfTheirKernel) {
  // Eigenvalues of K / 2: (1 +- k) / 2.
  const double k = std::exp(-0.5), p = 0.5 * (1 + k), q = 0.5 * (1 - k);
  EXPECT_NEAR(VendiScore(Between({0, 3}, {0, 3}), 3.0),
              std::exp(-p * std::log(p) - q * std::log(q)), 1e-9);
}

TEST(VendiScore, WithoutAScaleCountsGroupsOfEqualShapes) {
  EXPECT_NEAR(VendiScore(Between({0, 0, 1, 1}, {0, 0, 1, 1}), 0.0), 2.0, 1e-9);
}

}  // namespace
}  // namespace antigrasp
