#include "antigrasp/datasets/chamfer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/nearest_points.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3f;

std::vector<Vector3f> Cloud(int count, std::uint64_t seed) {
  RngStream rng(seed, "cloud");
  std::vector<Vector3f> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(static_cast<float>(rng.Normal()), static_cast<float>(rng.Normal()),
                        static_cast<float>(rng.Normal()));
  }
  return points;
}

std::vector<Vector3f> OnSphere(float radius, int count, std::uint64_t seed) {
  std::vector<Vector3f> points = Cloud(count, seed);
  for (Vector3f& point : points) point = radius * point.normalized();
  return points;
}

TEST(NearestSquared, IsThatOfThePlainDoubleLoopBitForBit) {
  for (const int count : {1, 2, 15, 16, 17, 100, 1024}) {
    const PointSet from(Cloud(count, 1)), to(Cloud(333, 2));
    std::vector<float> squared;
    NearestSquared(from, to, &squared);
    for (std::size_t b = 0; b < from.blocks().size(); ++b) {
      const auto& query = from.blocks()[b];
      for (std::size_t lane = 0; lane < PointSet::kBlock; ++lane) {
        float expected = std::numeric_limits<float>::infinity();
        for (const auto& block : to.blocks()) {
          for (std::size_t j = 0; j < block.used; ++j) {
            const float dx = query.x[lane] - block.x[j], dy = query.y[lane] - block.y[j],
                        dz = query.z[lane] - block.z[j];
            expected = std::min(expected, (dx * dx + dy * dy) + dz * dz);
          }
        }
        EXPECT_EQ(squared[b * PointSet::kBlock + lane], expected);
      }
    }
  }
}

void ExpectTight(const std::array<float, PointSet::kBlock>& lanes, float low, float high) {
  EXPECT_EQ(*std::min_element(lanes.begin(), lanes.end()), low);
  EXPECT_EQ(*std::max_element(lanes.begin(), lanes.end()), high);
}

TEST(PointSet, KeepsEveryPointOnceInATightBox) {
  const PointSet set(Cloud(1000, 3));
  std::size_t used = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), expected = sum;
  for (std::size_t b = 0; b < set.blocks().size(); ++b) {
    const auto& block = set.blocks()[b];
    used += block.used;
    for (std::size_t lane = 0; lane < block.used; ++lane) {
      sum += Eigen::Vector3d(block.x[lane], block.y[lane], block.z[lane]);
    }
    ExpectTight(block.x, set.boxes().low[0][b], set.boxes().high[0][b]);
    ExpectTight(block.y, set.boxes().low[1][b], set.boxes().high[1][b]);
    ExpectTight(block.z, set.boxes().low[2][b], set.boxes().high[2][b]);
  }
  for (const Vector3f& point : Cloud(1000, 3)) expected += point.cast<double>();
  EXPECT_EQ(used, 1000u);
  EXPECT_EQ(set.size(), 1000u);
  EXPECT_LT((sum - expected).norm(), 1e-9);
}

TEST(PointSet, RefusesNothingAndNonsense) {
  EXPECT_THROW(PointSet({}), std::logic_error);
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_THROW(PointSet({Vector3f(0, inf, 0)}), std::logic_error);
  EXPECT_THROW(PointSet({Vector3f(std::nanf(""), 0, 0)}), std::logic_error);
}

TEST(Chamfer, OfTwoPointsToOneIsByHand) {
  const PointSet two({Vector3f(0, 0, 0), Vector3f(4, 0, 0)}), one({Vector3f(1, 0, 0)});
  // (1 + 3) / 2 from the two, 1 from the one.
  EXPECT_DOUBLE_EQ(Chamfer(two, one), 1.5);
  EXPECT_DOUBLE_EQ(Chamfer(one, two), 1.5);
}

TEST(Chamfer, LooksAlongEveryAxis) {
  const PointSet origin({Vector3f(1, 1, 1)});
  EXPECT_DOUBLE_EQ(Chamfer(origin, PointSet({Vector3f(3, 4, 7)})), 7.0);  // 2, 3, 6
  EXPECT_DOUBLE_EQ(Chamfer(origin, PointSet({Vector3f(1, 6, 1)})), 5.0);
  EXPECT_DOUBLE_EQ(Chamfer(origin, PointSet({Vector3f(1, 1, -3)})), 4.0);
}

TEST(Chamfer, OfEqualSetsIsZeroInAnyOrder) {
  std::vector<Vector3f> points = Cloud(500, 4);
  const PointSet forward(points);
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(Chamfer(forward, PointSet(points)), 0.0);
}

TEST(Chamfer, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  const PointSet small(OnSphere(1.0F, 4000, 5)), large(OnSphere(2.0F, 4000, 6));
  // Points miss each other sideways too, which adds a little.
  const double distance = Chamfer(small, large);
  EXPECT_GE(distance, 1.0);
  EXPECT_LT(distance, 1.005);
}

TEST(Chamfer, OfTwoSamplingsIsHalfTheSpacingOfPoints) {
  const TriangleMesh box = shapes::Box({1, 2, 3});
  const PointSet a = SurfacePoints(box, 4096, 1, 0, 0), b = SurfacePoints(box, 4096, 1, 1, 0);
  // The mean distance from a place to the nearest of random points of density rho in the plane is
  // 1 / (2 sqrt(rho)).
  EXPECT_NEAR(Chamfer(a, b), 0.5 * std::sqrt(22.0 / 4096), 0.001);
  EXPECT_EQ(Chamfer(a, SurfacePoints(box, 4096, 1, 0, 0)), 0.0);
}

TEST(Chamfer, DoesNotChangeWhenBothMoveAlike) {
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(0.7F, Vector3f(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vector3f> a = Cloud(300, 7), b = OnSphere(1.5F, 200, 8);
  const double before = Chamfer(PointSet(a), PointSet(b));
  for (auto* points : {&a, &b}) {
    for (Vector3f& point : *points) point = turn * point + Vector3f(0.3F, -2, 1);
  }
  EXPECT_NEAR(Chamfer(PointSet(a), PointSet(b)), before, 1e-6 * before);
}

TEST(ChamferMatrix, IsSymmetricAndTheSameAtAnyThreadCount) {
  std::vector<PointSet> shapes;
  for (std::uint64_t i = 0; i < 9; ++i) shapes.emplace_back(Cloud(100 + int(i), i));
  const DistanceMatrix one = ChamferMatrix(shapes, 1), four = ChamferMatrix(shapes, 4);
  EXPECT_EQ(one, four);
  EXPECT_EQ(one, one.transpose());
  EXPECT_EQ(one.diagonal().norm(), 0.0F);
  shapes.pop_back();
  const DistanceMatrix even = ChamferMatrix(shapes, 2);
  EXPECT_EQ(even, one.topLeftCorner(8, 8));
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      EXPECT_EQ(even(i, j),
                static_cast<float>(Chamfer(shapes[std::size_t(i)], shapes[std::size_t(j)])));
    }
  }
}

TEST(NearestChamfer, IsTheSmallestOfTheRow) {
  std::vector<PointSet> shapes, others;
  for (std::uint64_t i = 0; i < 3; ++i) shapes.emplace_back(Cloud(50, i));
  for (std::uint64_t i = 2; i < 6; ++i) others.emplace_back(Cloud(50, i));
  const std::vector<double> nearest = NearestChamfer(shapes, others, 2);
  EXPECT_EQ(nearest[2], 0.0);  // cloud 2 is among the others
  double least = Chamfer(shapes[0], others[0]);
  for (const PointSet& other : others) least = std::min(least, Chamfer(shapes[0], other));
  EXPECT_EQ(nearest[0], least);
  EXPECT_THROW(NearestChamfer(shapes, {}, 1), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
