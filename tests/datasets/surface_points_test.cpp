#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/chamfer.h"
#include "antigrasp/mesh/surface_sampler.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

std::vector<Vector3f> PointsOf(const PointSet& set) {
  std::vector<Vector3f> points;
  for (const auto& block : set.blocks()) {
    for (std::size_t lane = 0; lane < block.used; ++lane) {
      points.emplace_back(block.at[0][lane], block.at[1][lane], block.at[2][lane]);
    }
  }
  return points;
}

TEST(SurfacePoints, AreDrawnFromTheStreamOfSeedSetAndShape) {
  const TriangleMesh box = shapes::Box({1, 2, 3});
  const SurfaceSampler sampler(box);
  RngStream rng(7, "surface points", 2, 5);
  std::vector<Vector3f> drawn;
  for (int i = 0; i < 100; ++i) drawn.push_back(sampler.Draw(&rng).point.cast<float>());
  const PointSet points = SurfacePoints(box, 100, 7, 2, 5);
  EXPECT_EQ(Chamfer(points, PointSet(drawn)), 0.0);
  // Seed, set and shape each change them, and none stands in for another.
  for (const PointSet& other :
       {SurfacePoints(box, 100, 8, 2, 5), SurfacePoints(box, 100, 7, 3, 5),
        SurfacePoints(box, 100, 7, 2, 6), SurfacePoints(box, 100, 7, 5, 2)}) {
    EXPECT_GT(Chamfer(points, other), 0.01);
  }
}

TEST(SurfacePoints, WithNormalsAreTheSamePointsBesideTheOutwardNormalsOfTheirFaces) {
  const TriangleMesh box = shapes::Box({2, 2, 2});
  const Vector3d origin(0.5, 0.25, 0.125);
  const OrientedPointSet oriented = OrientedSurfacePoints(box, 200, 7, 2, 5, 0.5, origin);
  std::vector<Vector3f> places;
  for (const auto& block : oriented.blocks()) {
    for (std::size_t lane = 0; lane < block.used; ++lane) {
      places.emplace_back(block.at[0][lane], block.at[1][lane], block.at[2][lane]);
      const Vector3f normal(block.at[3][lane], block.at[4][lane], block.at[5][lane]);
      EXPECT_NEAR(normal.norm(), 0.5F, 1e-6F);
      const Vector3f place = places.back() + origin.cast<float>();
      EXPECT_NEAR(place.dot(normal), 0.5F, 1e-6F);  // 1 from the middle along the normal
    }
  }
  EXPECT_EQ(Chamfer(PointSet(places), SurfacePoints(box, 200, 7, 2, 5, origin)), 0.0);
}

// A square of side 1 and one of side 3 high above it: one point in ten lies on the small one.
TEST(SurfacePoints, FallOnAnAreaByItsSize) {
  const TriangleMesh squares = shapes::Joined(
      shapes::FlatSquare(), Transformed(shapes::FlatSquare(), 3.0, Vector3d(0, 0, 5)));
  const std::vector<Vector3f> points = PointsOf(SurfacePoints(squares, 4000, 1, 0, 0));
  ASSERT_EQ(points.size(), 4000U);
  double low = 0.0;
  Vector3d mean = Vector3d::Zero(), square = mean;
  for (const Vector3f& point : points) {
    if (point.z() < 1.0F) {
      low += 1.0;
    } else {
      const Vector3d p = point.cast<double>();
      mean += p;
      square += p.cwiseProduct(p);
    }
  }
  EXPECT_NEAR(low / 4000, 0.1, 0.015);  // three deviations of 4000 draws
  // Uniform over a side of 3: variance 9 / 12.
  const double high = 4000 - low;
  EXPECT_LT((mean / high - Vector3d(0, 0, 5)).norm(), 0.06);
  EXPECT_NEAR(square.x() / high, 0.75, 0.04);
  EXPECT_NEAR(square.y() / high, 0.75, 0.04);
}

}  // namespace
}  // namespace antigrasp
