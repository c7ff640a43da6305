#include "antigrasp/datasets/set_comparison.h"

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

// Every number is another one with samples and reference swapped; only 1-NNA knows no sides.
TEST(CompareSets, OfThreeShapesIsByHand) {
  const SetComparison found = Compare({0, 9, 12}, {10, 20, 40});
  EXPECT_DOUBLE_EQ(found.coverage, 1.0 / 3);             // all three are nearest to 10
  EXPECT_DOUBLE_EQ(found.matching, (1 + 8 + 28) / 3.0);  // 10 to 9, 20 to 12, 40 to 12
  EXPECT_DOUBLE_EQ(found.to_reference, (10 + 1 + 2) / 3.0);
  EXPECT_DOUBLE_EQ(found.within_reference, (10 + 10 + 20) / 3.0);
  EXPECT_DOUBLE_EQ(found.nna, 2.0 / 6);  // 0 (9 < 10) and 40 (20 < 28)

  const SetComparison swapped = Compare({10, 20, 40}, {0, 9, 12});
  EXPECT_DOUBLE_EQ(swapped.coverage, 2.0 / 3);  // 10 to 9, the others to 12
  EXPECT_DOUBLE_EQ(swapped.matching, (10 + 1 + 2) / 3.0);
  EXPECT_DOUBLE_EQ(swapped.to_reference, (1 + 8 + 28) / 3.0);
  EXPECT_DOUBLE_EQ(swapped.within_reference, (9 + 3 + 3) / 3.0);
  EXPECT_DOUBLE_EQ(swapped.nna, 2.0 / 6);
}

TEST(CompareSets, CountsTiesAgainstTheOwnSet) {
  // 2 is as far from 0 as from 4. 0 (2 < 4) and 100 (96 < 98) are nearer to their own, 4 is not.
  EXPECT_DOUBLE_EQ(Compare({0, 2}, {4, 100}).nna, 2.0 / 4);
  EXPECT_DOUBLE_EQ(Compare({4, 100}, {0, 2}).nna, 2.0 / 4);
}

TEST(CompareSpreads, OfFiveShapesIsByHand) {
  // Nearest others: 10, 10, 6, 5, 5 and 1, 1, 19, 21, 21.
  const SpreadComparison found = Spreads({0, 10, 20, 26, 31}, {0, 1, 20, 41, 62});
  EXPECT_DOUBLE_EQ(found.samples.mean_distance, 156 / 10.0);
  EXPECT_DOUBLE_EQ(found.reference.mean_distance, 328 / 10.0);
  EXPECT_DOUBLE_EQ(found.diversity, 156.0 / 328);
  // The reference's pairs: 1 19 20 21 21 | 40 41 42 61 62. The samples' would say 11.
  EXPECT_DOUBLE_EQ(found.median_distance, 21.0);
  // Half the reference's median, 19 / 2.
  EXPECT_DOUBLE_EQ(found.samples.duplicates, 3.0 / 5);
  EXPECT_DOUBLE_EQ(found.reference.duplicates, 2.0 / 5);
}

TEST(CompareSpreads, TakesLowerMediansAndOnlyWhatIsNearer) {
  // Nearest others of the reference: 8, 8, 12, 21; all its pairs: 8 12 20 21 33 41.
  // Of the samples, 3, 3, 4, 5, two are nearer than 8 / 2; 4 is not.
  const SpreadComparison found = Spreads({0, 3, 7, 12}, {0, 8, 20, 41});
  EXPECT_DOUBLE_EQ(found.median_distance, 20.0);
  EXPECT_DOUBLE_EQ(found.samples.duplicates, 2.0 / 4);
  EXPECT_DOUBLE_EQ(found.reference.duplicates, 0.0);
}

TEST(CompareSpreads, HasNoDiversityBesideEqualReferences) {
  EXPECT_EQ(Spreads({0, 3}, {5, 5}).diversity, 0.0);
  EXPECT_EQ(Spreads({5, 5}, {0, 3}).diversity, 0.0);
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
  // Two scales apart: k = exp(-2 * 2 / 2). Eigenvalues of K / 2: (1 +- k) / 2.
  const double k = std::exp(-2.0), p = 0.5 * (1 + k), q = 0.5 * (1 - k);
  EXPECT_NEAR(VendiScore(Between({0, 6}, {0, 6}), 3.0),
              std::exp(-p * std::log(p) - q * std::log(q)), 1e-9);
}

TEST(VendiScore, LeavesNegativeEigenvaluesOut) {
  // 0 = 1 and 1 = 2, but 0 and 2 are far apart: K = [1 1 0; 1 1 1; 0 1 1] has the eigenvalues
  // 1 + sqrt(2), 1, 1 - sqrt(2); the positive ones are to each other as p and q.
  DistanceMatrix distances = DistanceMatrix::Zero(3, 3);
  distances(0, 2) = distances(2, 0) = 1000;
  const double q = 1 / (2 + std::sqrt(2.0)), p = 1 - q;
  EXPECT_NEAR(VendiScore(distances, 1.0), std::exp(-p * std::log(p) - q * std::log(q)), 1e-9);
}

TEST(VendiScore, WithoutAScaleCountsGroupsOfEqualShapes) {
  EXPECT_NEAR(VendiScore(Between({0, 0, 1, 1}, {0, 0, 1, 1}), 0.0), 2.0, 1e-9);
}

}  // namespace
}  // namespace antigrasp
