#include "antigrasp/export/wall_thickness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Over a regular polygon at z = 0, apex on the z axis.
TriangleMesh Cone(double radius, double height) {
  constexpr int kSides = 64;
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, height}};
  for (int i = 0; i < kSides; ++i) {
    const double u = 2.0 * std::numbers::pi * i / kSides;
    mesh.vertices.push_back({radius * std::cos(u), radius * std::sin(u), 0.0});
    const int a = 2 + i, b = 2 + (i + 1) % kSides;
    mesh.faces.push_back({0, b, a});
    mesh.faces.push_back({1, a, b});
  }
  return mesh;
}

TEST(WallThickness, ABoxIsAsThickAsItsShortestSide) {
  const WallThickness walls = MeasureWalls(shapes::Box({3.0, 2.0, 0.5}), {.thin = 1.0});
  ASSERT_TRUE(walls.smallest);
  EXPECT_NEAR(*walls.smallest, 0.5, 1e-6);
  EXPECT_NEAR(std::abs(walls.at.z()), 0.25, 1e-9);
  EXPECT_NEAR(walls.thin_share, 12.0 / 17.0, 0.03);  // top and bottom of the whole surface
  EXPECT_EQ(MeasureWalls(shapes::Box({3.0, 2.0, 0.5}), {.thin = 0.4}).thin_share, 0.0);
}

TEST(WallThickness, ABallIsAsThickAsItsDiameter) {
  EXPECT_NEAR(*MeasureWalls(shapes::Sphere(0.7, 4)).smallest, 1.4, 0.01);
}

TEST(WallThickness, AHollowBoxIsAsThickAsItsShell) {
  const TriangleMesh hollow = shapes::Joined(shapes::Box(Vector3d::Constant(2.0)),
                                             shapes::Inverted(shapes::Box({1.8, 1.6, 1.7})));
  EXPECT_NEAR(*MeasureWalls(hollow).smallest, 0.1, 1e-6);
}

TEST(WallThickness, ARingOfSquareSectionIsAsThickAsTheSquare) {
  const double side = 0.5 * std::sqrt(2.0);
  EXPECT_NEAR(*MeasureWalls(shapes::Torus(3.0, 0.5, 256, 4)).smallest, side, 0.01);
}

TEST(WallThickness, SidesThatFaceEachOtherNowhereAreNoWalls) {
  EXPECT_FALSE(MeasureWalls(shapes::Tetrahedron()).smallest);
  EXPECT_FALSE(MeasureWalls(Cone(1.0, 1.5)).smallest);  // half angle 34 degrees
  EXPECT_FALSE(MeasureWalls(shapes::FlatSquare()).smallest);
  EXPECT_FALSE(MeasureWalls(TriangleMesh()).smallest);
}

TEST(WallThickness, SidesAreAWallUpToTheAngleBetweenThem) {
  // A wedge of 40 degrees with its edge along y, 1 long in x and 9 wide: its slanted sides are 40
  // degrees from parallel, its two ends face each other squarely.
  const double h = std::tan(20.0 * std::numbers::pi / 180.0);
  const TriangleMesh wedge{
      {{0, 0, 0}, {0, 9, 0}, {1, 0, h}, {1, 9, h}, {1, 0, -h}, {1, 9, -h}},
      {{0, 3, 1}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}}};
  EXPECT_LT(*MeasureWalls(wedge, {.opposite_angle = 40.5}).smallest, 0.4);
  EXPECT_NEAR(*MeasureWalls(wedge, {.opposite_angle = 39.5}).smallest, 9.0, 1e-3);
  EXPECT_LT(*MeasureWalls(wedge).smallest, 0.4);  // the default is 45 degrees
}

TEST(WallThickness, TheSmallestOfTwoWallsIsNamedWithItsPlace) {
  const TriangleMesh thin = shapes::Box({1.0, 1.0, 0.2});
  const TriangleMesh thick = Transformed(shapes::Box({1.0, 1.0, 0.5}), 1.0, {5.0, 0.0, 0.0});
  for (const TriangleMesh& both : {shapes::Joined(thin, thick), shapes::Joined(thick, thin)}) {
    const WallThickness walls = MeasureWalls(both, {.thin = 0.3});
    EXPECT_NEAR(*walls.smallest, 0.2, 1e-6);
    EXPECT_LT(walls.at.x(), 1.0);
    // Two faces of area 1 of a surface of 2 + 4 x 0.2 + 2 + 4 x 0.5.
    EXPECT_NEAR(walls.thin_share, 2.0 / 6.8, 0.03);
  }
}

TEST(WallThickness, ANeedleIsThinWhereItEnds) {
  const TriangleMesh needle = Cone(0.1, 2.0);
  const WallThickness walls = MeasureWalls(needle, {.samples = 20000, .thin = 0.05});
  ASSERT_TRUE(walls.smallest);
  EXPECT_LT(*walls.smallest, 0.02);
  EXPECT_GT(walls.at.z(), 1.8);
  // Thinner than a quarter of the base: the last quarter, a sixteenth of the mantle.
  EXPECT_NEAR(walls.thin_share, 1.0 / 16.0, 0.01);
}

TEST(WallThickness, DoesNotDependOnWhereTheObjectLiesAndHowItIsTurned) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const TriangleMesh moved =
      Transformed(shapes::Rotated(shapes::Box({3.0, 2.0, 0.5}), turn), 10.0, {700, -300, 400});
  EXPECT_NEAR(*MeasureWalls(moved).smallest, 5.0, 1e-4);
}

}  // namespace
}  // namespace antigrasp
