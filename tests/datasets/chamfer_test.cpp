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

// Six normal numbers a point.
std::vector<OrientedPointSet::Point> SixfoldCloud(int count, std::uint64_t seed) {
  RngStream rng(seed, "cloud");
  std::vector<OrientedPointSet::Point> points(static_cast<std::size_t>(count));
  for (auto& point : points) {
    for (float& coordinate : point) coordinate = static_cast<float>(rng.Normal());
  }
  return points;
}

template <int D>
void ExpectThoseOfThePlainDoubleLoop(const PointBlocks<D>& from, const PointBlocks<D>& to) {
  std::vector<float> squared;
  NearestSquared(from, to, &squared);
  for (std::size_t b = 0; b < from.blocks().size(); ++b) {
    const auto& query = from.blocks()[b];
    for (std::size_t lane = 0; lane < PointSet::kBlock; ++lane) {
      float expected = std::numeric_limits<float>::infinity();
      for (const auto& block : to.blocks()) {
        for (std::size_t j = 0; j < block.used; ++j) {
          float sum = 0.0F;
          for (std::size_t k = 0; k < std::size_t{D}; ++k) {
            const float step = query.at[k][lane] - block.at[k][j];
            sum += step * step;
          }
          expected = std::min(expected, sum);
        }
      }
      EXPECT_EQ(squared[b * PointSet::kBlock + lane], expected);
    }
  }
}

TEST(NearestSquared, IsThatOfThePlainDoubleLoopBitForBit) {
  for (const int count : {1, 2, 15, 16, 17, 100, 1024}) {
    ExpectThoseOfThePlainDoubleLoop(PointSet(Cloud(count, 1)), PointSet(Cloud(333, 2)));
    ExpectThoseOfThePlainDoubleLoop(OrientedPointSet(SixfoldCloud(count, 1)),
                                    OrientedPointSet(SixfoldCloud(333, 2)));
    ExpectThoseOfThePlainDoubleLoop(PointSet(Cloud(333, 2)), PointSet(Cloud(count, 1)));
  }
  // 313 blocks in 20 groups, and those of one block, 16 and 17.
  for (const int count : {256, 257, 272, 5000}) {
    ExpectThoseOfThePlainDoubleLoop(PointSet(Cloud(100, 1)), PointSet(Cloud(count, 2)));
  }
}

// Blocks of 16 along a line, and groups of 16 blocks that meet at 256 / 512: what is nearest to a
// point just below that lies in the last block of the first group, and the second group is nearer.
TEST(NearestSquared, LooksIntoTheLastBlockOfAGroup) {
  std::vector<Vector3f> line;
  for (int i = 0; i < 512; ++i) line.emplace_back(static_cast<float>(i) / 512.0F, 0.0F, 0.0F);
  const PointSet query({Vector3f(254.5F / 512.0F, 0.02F, 0.0F)});
  std::vector<float> squared;
  NearestSquared(query, PointSet(line), &squared);
  EXPECT_NEAR(std::sqrt(squared[0]), std::hypot(0.5 / 512.0, 0.02), 1e-7);
}

TEST(NearestSquared, WithNormalsOfSurfacesIsThatOfThePlainDoubleLoopBitForBit) {
  const auto points = [](const TriangleMesh& mesh, std::uint64_t shape) {
    return OrientedSurfacePoints(mesh, 500, 1, 0, shape, 0.3);
  };
  ExpectThoseOfThePlainDoubleLoop(points(shapes::Box({1, 2, 3}), 0),
                                  points(shapes::Sphere(1.0, 3), 1));
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
      sum += Eigen::Vector3d(block.at[0][lane], block.at[1][lane], block.at[2][lane]);
    }
    ExpectTight(block.at[0], set.boxes().low[0][b], set.boxes().high[0][b]);
    ExpectTight(block.at[1], set.boxes().low[1][b], set.boxes().high[1][b]);
    ExpectTight(block.at[2], set.boxes().low[2][b], set.boxes().high[2][b]);
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

// A shape and the same one inside out: the same points, every normal turned by 180 degrees.
TEST(Chamfer, WithNormalsIsTheirTurnByTheirLength) {
  const TriangleMesh square = shapes::FlatSquare(), turned = shapes::Inverted(square);
  const auto points = [](const TriangleMesh& mesh, double length) {
    return OrientedSurfacePoints(mesh, 500, 1, 0, 0, length);
  };
  EXPECT_EQ(Chamfer(points(square, 0.25), points(square, 0.25)), 0.0);
  const double apart = Chamfer(points(square, 0.25), points(turned, 0.25));
  EXPECT_GE(apart, 0.5);  // points of either are drawn on faces of another order
  EXPECT_LT(apart, 0.51);
  const double same =
      Chamfer(SurfacePoints(square, 500, 1, 0, 0), SurfacePoints(turned, 500, 1, 0, 0));
  EXPECT_NEAR(Chamfer(points(square, 0.0), points(turned, 0.0)), same, 1e-7);
}

TEST(Chamfer, WithNormalsSeesRipplesThatHardlyMoveASurface) {
  // A plane of strips that lean 30 degrees to either side in turn, 0.005 high, and a flat one.
  TriangleMesh flat, ripples;
  for (int i = 0; i <= 100; ++i) {
    const double x = 0.01 * i, height = i % 2 == 0 ? 0.0 : 0.01 * std::tan(M_PI / 6);
    flat.vertices.insert(flat.vertices.end(), {{x, 0, 0}, {x, 1, 0}});
    ripples.vertices.insert(ripples.vertices.end(), {{x, 0, height}, {x, 1, height}});
  }
  for (std::int32_t i = 0; i < 200; i += 2) {
    flat.faces.insert(flat.faces.end(), {{i, i + 2, i + 3}, {i, i + 3, i + 1}});
  }
  ripples.faces = flat.faces;
  const double place = Chamfer(SurfacePoints(flat, 2000, 1, 0, 0),
                               SurfacePoints(ripples, 2000, 1, 1, 0)),
               floor =
                   Chamfer(SurfacePoints(flat, 2000, 1, 0, 0), SurfacePoints(flat, 2000, 1, 1, 0));
  EXPECT_LT(place, 1.3 * floor);
  const double turned = Chamfer(OrientedSurfacePoints(flat, 2000, 1, 0, 0, 0.1),
                                OrientedSurfacePoints(ripples, 2000, 1, 1, 0, 0.1));
  // Every normal leans by 30 degrees.
  EXPECT_NEAR(turned, std::hypot(0.2 * std::sin(M_PI / 12), place), 0.002);
  EXPECT_GT(turned, 4 * floor);
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
  std::vector<OrientedPointSet> oriented;
  for (std::uint64_t i = 0; i < 5; ++i) oriented.emplace_back(SixfoldCloud(60 + int(i), i));
  EXPECT_EQ(ChamferMatrix(oriented, 1), ChamferMatrix(oriented, 4));
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
