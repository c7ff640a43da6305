#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/bundle/object_size_rule.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/convex_hull.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

TEST(OrientedExtents, OfATurnedBoxAreItsEdges) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d extents = OrientedExtents(shapes::Rotated(shapes::Box({3, 1, 2}), turn));
  EXPECT_TRUE(extents.isApprox(Eigen::Vector3d(1, 2, 3), 1e-9)) << extents.transpose();
}

// Of every facet and every pair of corners: an edge of the outline is one of them.
double SmallestVolume(const TriangleMesh& hull) {
  double least = std::numeric_limits<double>::max();
  for (std::size_t f = 0; f < hull.faces.size(); ++f) {
    const Eigen::Vector3d up = FaceCross(hull, f).normalized();
    for (const Eigen::Vector3d& a : hull.vertices) {
      for (const Eigen::Vector3d& b : hull.vertices) {
        const Eigen::Vector3d along = (b - a) - up * up.dot(b - a);
        if (along.norm() < 1e-9) continue;
        Eigen::Matrix3d axes;
        axes << up, along.normalized(), up.cross(along.normalized());
        Eigen::Array3d low = Eigen::Array3d::Constant(1e9), high = -low;
        for (const Eigen::Vector3d& corner : hull.vertices) {
          const Eigen::Array3d at = axes.transpose() * corner;
          low = low.min(at);
          high = high.max(at);
        }
        least = std::min(least, (high - low).prod());
      }
    }
  }
  return least;
}

TEST(OrientedExtents, AreTheSmallestOfAllBoxesThatAreFlushWithAFacet) {
  for (std::uint64_t item = 0; item < 5; ++item) {
    RngStream rng(7, "points", item);
    std::vector<Eigen::Vector3d> points(14);
    for (Eigen::Vector3d& point : points) {
      for (double& x : point) x = rng.Uniform(0.0, 1.0);
    }
    const TriangleMesh hull = ConvexHull(points);
    EXPECT_NEAR(OrientedExtents(hull).prod(), SmallestVolume(hull), 1e-12) << item;
  }
}

// Of a regular one with its corners on the axes opposite facets are 2 / sqrt(3) apart, and from
// above a facet it is a hexagon of radius sqrt(2 / 3).
TEST(OrientedExtents, OfAnOctahedronAreKnown) {
  std::vector<Eigen::Vector3d> corners;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) corners.push_back(sign * Eigen::Vector3d::Unit(axis));
  }
  const Eigen::Vector3d expected(2 / std::sqrt(3), std::sqrt(2), 2 * std::sqrt(2.0 / 3));
  EXPECT_TRUE(OrientedExtents(ConvexHull(corners)).isApprox(expected, 1e-12));
}

// A prism over a regular polygon of 4096 corners, 8188 triangles in two facets and many slim sides:
// flush with a side it is 2 r cos(pi / n) wide both ways.
TEST(OrientedExtents, OfADiscAreItsWidthAcrossFlatsAndItsHeight) {
  constexpr int kCorners = 4096;
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    for (const double z : {0.0, 0.1}) corners.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  const double across = 2 * std::cos(std::numbers::pi / kCorners);
  EXPECT_TRUE(
      OrientedExtents(ConvexHull(corners)).isApprox(Eigen::Vector3d(0.1, across, across), 1e-9));
}

TEST(OrientedExtents, OfAFlatMeshAreZero) {
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sheet.faces = {{0, 1, 2}};
  EXPECT_EQ(OrientedExtents(sheet), Eigen::Vector3d::Zero());
}

TEST(EgadScale, MakesTheLongestSideAsWideAsTheGripperOpens) {
  EXPECT_NEAR(EgadScale({1, 2, 4}, 0.08), 0.02, 1e-15);
}

TEST(EgadScale, LeavesTheShortestSideFourFifthsOfTheOpening) {
  EXPECT_NEAR(EgadScale({2, 2, 2}, 0.08), 0.8 * 0.08 / 2, 1e-15);
}

}  // namespace
}  // namespace antigrasp
