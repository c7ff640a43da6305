// Parts of grafted solids in a pose of their own, all sizes different, so that an axis, a corner or
// a direction taken for another shows.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "antigrasp/datasets/grafted_solid.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Own x, y, z point along the world's y, z, x.
Eigen::Matrix3d Turned() {
  Eigen::Matrix3d axes;
  axes.col(0) = Vector3d::UnitY();
  axes.col(1) = Vector3d::UnitZ();
  axes.col(2) = Vector3d::UnitX();
  return axes;
}

const Vector3d kCenter(10, 20, 30);

// Reaches 3 along x, 1 along y, 2 along z from its centre.
Primitive Box() { return {Primitive::Shape::kBox, kCenter, Turned(), {1, 2, 3}}; }

// Radius 1, its axis from -3 to 3 along x.
Primitive Cylinder() { return {Primitive::Shape::kCylinder, kCenter, Turned(), {1, 1, 3}}; }

double At(const Primitive& part, double x, double y, double z) {
  return SignedDistance(part, kCenter + Vector3d(x, y, z));
}

TEST(Primitive, DistancesOfATurnedBoxAreThoseOnPaper) {
  EXPECT_DOUBLE_EQ(At(Box(), 0, 0, 0), 1.0);
  EXPECT_DOUBLE_EQ(At(Box(), 2.75, 0, 0), 0.25);
  EXPECT_DOUBLE_EQ(At(Box(), 0, 0, -1.5), 0.5);
  EXPECT_DOUBLE_EQ(At(Box(), 0, 4, 0), -3.0);
  EXPECT_DOUBLE_EQ(At(Box(), -7, 0, 0), -4.0);
  EXPECT_DOUBLE_EQ(At(Box(), 3 + 2, 1 + 3, 2 + 6), -7.0);  // from the corner
}

TEST(Primitive, DistancesOfATurnedCylinderAreThoseOnPaper) {
  EXPECT_DOUBLE_EQ(At(Cylinder(), 0, 0, 0), 1.0);
  EXPECT_DOUBLE_EQ(At(Cylinder(), 2.75, 0, 0), 0.25);
  EXPECT_DOUBLE_EQ(At(Cylinder(), 0, 3, 4), -4.0);
  EXPECT_DOUBLE_EQ(At(Cylinder(), 3 + 3, 0, 1 + 4), -5.0);  // from the rim
  EXPECT_DOUBLE_EQ(At(Cylinder(), -5, 0.5, 0), -2.0);
}

TEST(Primitive, NearestPointsFromInsideAreThoseOnPaper) {
  const auto nearest = [](const Primitive& part, double x, double y, double z) -> Vector3d {
    return NearestFromInside(part, kCenter + Vector3d(x, y, z)) - kCenter;
  };
  EXPECT_LT((nearest(Box(), -2.75, 0.5, 1) - Vector3d(-3, 0.5, 1)).norm(), 1e-12);
  EXPECT_LT((nearest(Box(), 1, -0.75, 1) - Vector3d(1, -1, 1)).norm(), 1e-12);
  EXPECT_LT((nearest(Cylinder(), -2.75, 0.5, 0) - Vector3d(-3, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((nearest(Cylinder(), 1, 0.3, -0.4) - Vector3d(1, 0.6, -0.8)).norm(), 1e-12);
  // On the axis any direction will do, but one of them.
  EXPECT_NEAR(At(Cylinder(), 1, 0, 0), 1.0, 1e-12);
  EXPECT_NEAR(nearest(Cylinder(), 1, 0, 0).tail<2>().norm(), 1.0, 1e-12);
}

TEST(Primitive, BoundsOfTurnedPartsReachBothWays) {
  EXPECT_LT((Bounds(Box()).min - (kCenter - Vector3d(3, 1, 2))).norm(), 1e-12);
  EXPECT_LT((Bounds(Box()).max - (kCenter + Vector3d(3, 1, 2))).norm(), 1e-12);
  EXPECT_LT((Bounds(Cylinder()).min - (kCenter - Vector3d(3, 1, 1))).norm(), 1e-12);
  EXPECT_LT((Bounds(Cylinder()).max - (kCenter + Vector3d(3, 1, 1))).norm(), 1e-12);
}

TEST(Primitive, BoundsOfATiltedBoxAreTight) {
  Primitive box = Box();
  box.axes = Eigen::AngleAxisd(std::numbers::pi / 6, Vector3d::UnitZ()).matrix();
  // x: 1 cos 30 + 2 sin 30, y: 1 sin 30 + 2 cos 30.
  const Vector3d reach(0.5 * std::sqrt(3.0) + 1, 0.5 + std::sqrt(3.0), 3);
  EXPECT_LT((Bounds(box).max - kCenter - reach).norm(), 1e-12);
}

TEST(GraftedSolid, BoundsHoldEveryPartBothWays) {
  Primitive low = Box(), high = Cylinder();
  low.center = {-10, 0, 1};
  high.center = {5, 2, 0};
  const GraftedSolid one({low, high}), other({high, low});
  for (const BoundingBox& box : {one.Bounds(), other.Bounds()}) {
    EXPECT_LT((box.min - Vector3d(-13, -1, -1)).norm(), 1e-12);
    EXPECT_LT((box.max - Vector3d(8, 3, 3)).norm(), 1e-12);
  }
  EXPECT_THROW(GraftedSolid({}), std::logic_error);
}

TEST(GraftedSolid, FindsTheSameWhateverPartComesFirst) {
  Primitive graft = Cylinder();
  graft.center = kCenter + Vector3d(0, 0, 2);
  graft.axes = Eigen::Matrix3d::Identity();  // along z
  const GraftedSolid one({Box(), graft}), other({graft, Box()});
  for (int i = 0; i < 200; ++i) {
    const Vector3d p =
        kCenter + Vector3d(-3.5 + i % 8, -1.5 + 0.8 * (i / 8 % 5), -2.5 + 1.6 * (i / 40));
    EXPECT_NEAR(one.SignedDistance(p), other.SignedDistance(p), 2e-3);
  }
}

// A post of radius 1 through a plate: deep inside, the nearest sides of both are buried in each
// other.
TEST(GraftedSolid, MeasuresPastABuriedWallToTheBareOne) {
  Primitive plate = Box(), post = Cylinder();
  plate.center = post.center = Vector3d::Zero();
  plate.axes = post.axes = Eigen::Matrix3d::Identity();
  plate.half = {4, 4, 2};  // the post sticks 1 out of it above and below
  const GraftedSolid solid({plate, post});
  // In the middle: the rim where post and plate meet is nearer than the post's end, nearest in the
  // middle of one of its 64 sides.
  const double side = std::cos(std::numbers::pi / 64);
  EXPECT_NEAR(solid.SignedDistance({0, 0, 0}), std::sqrt(side * side + 4), 1e-9);
  EXPECT_NEAR(solid.SignedDistance({0, 0, 1}), std::sqrt(side * side + 1), 1e-9);
  EXPECT_NEAR(solid.SignedDistance({2, 0, 0}), 2.0, 1e-12);
  EXPECT_NEAR(solid.SignedDistance({0, 0, 2.75}), 0.25, 1e-12);
  EXPECT_NEAR(solid.SignedDistance({0, 0, 3.5}), -0.5, 1e-12);
}

}  // namespace
}  // namespace antigrasp
