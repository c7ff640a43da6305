#include "antigrasp/export/overhang.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(Overhang, ACubeOnItsFaceRestsOnItAndNothingHangsOver) {
  const Overhang overhang = MeasureOverhang(shapes::Cube(), Vector3d::UnitZ(), 45.0, 0.01);
  EXPECT_EQ(overhang.share, 0.0);
  EXPECT_NEAR(overhang.contact_area, 1.0, 1e-12);
}

TEST(Overhang, ACubeOnItsEdgeHangsOverOnlyWhenLessThan45DegreesAreAllowed) {
  const Vector3d up = Vector3d(1.0, 0.0, 1.0).normalized();
  EXPECT_EQ(MeasureOverhang(shapes::Cube(), up, 45.0, 0.01).share, 0.0);
  EXPECT_NEAR(MeasureOverhang(shapes::Cube(), up, 44.0, 0.01).share, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(MeasureOverhang(shapes::Cube(), up, 44.0, 0.01).contact_area, 0.0);
}

TEST(Overhang, ALyingCylinderHangsOverOnAQuarterOfItsMantle) {
  const double mantle = 3.0 / (3.0 + 1.0);  // height 3 r: 2 pi r h beside 2 pi r^2
  const TriangleMesh cylinder = shapes::Cylinder(1.0, 3.0, 720);
  EXPECT_NEAR(MeasureOverhang(cylinder, Vector3d::UnitX(), 45.0, 0.0).share, 0.25 * mantle, 2e-3);
  EXPECT_EQ(MeasureOverhang(cylinder, Vector3d::UnitZ(), 45.0, 0.0).share, 0.0);
}

TEST(Overhang, ABallHangsOverOnTheCapBelow45Degrees) {
  const double cap = 0.5 * (1.0 - std::sin(std::numbers::pi / 4.0));
  const TriangleMesh ball = shapes::Sphere(2.0, 4);
  EXPECT_NEAR(MeasureOverhang(ball, Vector3d(0.3, 0.4, 1.0).normalized(), 45.0, 0.0).share, cap,
              0.005);
}

TEST(Overhang, WhatLiesWithinTheFirstLayerRestsOnThePlate) {
  const TriangleMesh raised = Transformed(shapes::Cube(), 1.0, {3.0, 0.0, 0.1});
  const TriangleMesh pair = shapes::Joined(shapes::Cube(), raised);
  EXPECT_NEAR(MeasureOverhang(pair, Vector3d::UnitZ(), 45.0, 0.05).share, 1.0 / 12.0, 1e-12);
  EXPECT_NEAR(MeasureOverhang(pair, Vector3d::UnitZ(), 45.0, 0.05).contact_area, 1.0, 1e-12);
  EXPECT_EQ(MeasureOverhang(pair, Vector3d::UnitZ(), 45.0, 0.15).share, 0.0);
  EXPECT_NEAR(MeasureOverhang(pair, Vector3d::UnitZ(), 45.0, 0.15).contact_area, 2.0, 1e-12);
}

TEST(Overhang, WhichWayIsUpMakesTheDifference) {
  // Corners 0, e_x, e_y, e_z: three sides of area 1 / 2 along the axes and the slope (1, 1, 1) of
  // sqrt(3) / 2, which is asin(1 / sqrt(3)) = 35.26 degrees from vertical along each axis.
  const TriangleMesh corner = shapes::Tetrahedron();
  const double slope = 0.5 * std::sqrt(3.0), whole = 1.5 + slope;
  EXPECT_EQ(MeasureOverhang(corner, Vector3d::UnitZ(), 0.0, 0.01).share, 0.0);
  EXPECT_NEAR(MeasureOverhang(corner, Vector3d::UnitZ(), 0.0, 0.01).contact_area, 0.5, 1e-12);
  EXPECT_NEAR(MeasureOverhang(corner, -Vector3d::UnitZ(), 35.2, 0.01).share, slope / whole, 1e-12);
  EXPECT_EQ(MeasureOverhang(corner, -Vector3d::UnitZ(), 35.3, 0.01).share, 0.0);
  EXPECT_EQ(MeasureOverhang(corner, -Vector3d::UnitZ(), 35.2, 0.01).contact_area, 0.0);
  // Without a layer at all the bottom face still rests, the ceiling of 90 degrees hangs over.
  EXPECT_NEAR(MeasureOverhang(corner, Vector3d::UnitZ(), 89.0, 0.0).contact_area, 0.5, 1e-12);
  const TriangleMesh raised =
      shapes::Joined(corner, Transformed(shapes::Cube(), 1.0, {0.0, 0.0, 5.0}));
  EXPECT_NEAR(MeasureOverhang(raised, Vector3d::UnitZ(), 89.0, 0.0).share, 1.0 / (6.0 + whole),
              1e-12);
}

}  // namespace
}  // namespace antigrasp
