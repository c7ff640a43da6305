#include "antigrasp/datasets/grafted_solid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

Primitive Box(const Vector3d& center, const Vector3d& half) {
  return {Primitive::Shape::kBox, center, Eigen::Matrix3d::Identity(), half};
}

Primitive Cylinder(const Vector3d& center, double radius, double half_height) {
  return {Primitive::Shape::kCylinder,
          center,
          Eigen::Matrix3d::Identity(),
          {radius, radius, half_height}};
}

Vector3d RandomPoint(RngStream& rng, double half) {
  const double x = rng.Uniform(-half, half), y = rng.Uniform(-half, half);
  return {x, y, rng.Uniform(-half, half)};
}

TEST(Primitive, CylinderDistancesAreThoseOnPaper) {
  const Primitive c = Cylinder(Vector3d::Zero(), 0.2, 0.5);
  EXPECT_DOUBLE_EQ(SignedDistance(c, {0, 0, 0}), 0.2);
  EXPECT_DOUBLE_EQ(SignedDistance(c, {0, 0, 0.45}), 0.05);
  EXPECT_DOUBLE_EQ(SignedDistance(c, {0.3, 0.4, 0}), -0.3);
  EXPECT_DOUBLE_EQ(SignedDistance(c, {0, 0.1, 0.8}), -0.3);
  EXPECT_DOUBLE_EQ(SignedDistance(c, {0, 0.2 + 0.3, 0.5 + 0.4}), -0.5);  // to the rim: 3-4-5
}

TEST(Primitive, NearestPointFromInsideIsAsFarAsTheDistanceAndOnTheSurface) {
  RngStream rng(1, "nearest");
  Primitive cylinder = Cylinder({0.1, 0, 0}, 0.3, 0.4), box = Box({0, 0.1, 0}, {0.3, 0.4, 0.2});
  cylinder.axes = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).matrix();
  box.axes = Eigen::AngleAxisd(1.1, Vector3d(3, 1, 2).normalized()).matrix();
  for (const Primitive& part : {cylinder, box}) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3d p = RandomPoint(rng, 0.5);
      const double distance = SignedDistance(part, p);
      if (distance <= 0.0) continue;
      const Vector3d nearest = NearestFromInside(part, p);
      EXPECT_NEAR((nearest - p).norm(), distance, 1e-14);
      EXPECT_NEAR(SignedDistance(part, nearest), 0.0, 1e-14);
    }
  }
}

TEST(Primitive, BoundsOfATiltedCylinderAreTight) {
  Primitive c = Cylinder(Vector3d::Zero(), 0.1, 0.5);
  c.axes = Eigen::AngleAxisd(std::numbers::pi / 4, Vector3d::UnitX()).matrix();
  const double reach = (0.5 + 0.1) / std::sqrt(2.0);
  EXPECT_LT((Bounds(c).max - Vector3d(0.1, reach, reach)).norm(), 1e-15);
}

// Two boxes that overlap into one: the right distance inside is the long box's.
TEST(GraftedSolid, OverlappingBoxesMeasureAsTheirUnion) {
  const GraftedSolid solid(
      {Box({-0.1, 0, 0}, {0.2, 0.15, 0.1}), Box({0.1, 0, 0}, {0.2, 0.15, 0.1})});
  const Primitive whole = Box(Vector3d::Zero(), {0.3, 0.15, 0.1});
  RngStream rng(2, "points");
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = RandomPoint(rng, 0.4);
    EXPECT_NEAR(solid.SignedDistance(p), SignedDistance(whole, p), 1e-12);
  }
}

TEST(GraftedSolid, OverlappingCylindersMeasureAsTheirUnion) {
  const GraftedSolid solid({Cylinder({0, 0, -0.1}, 0.2, 0.2), Cylinder({0, 0, 0.1}, 0.2, 0.2)});
  const Primitive whole = Cylinder(Vector3d::Zero(), 0.2, 0.3);
  RngStream rng(3, "points");
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = RandomPoint(rng, 0.4);
    EXPECT_NEAR(solid.SignedDistance(p), SignedDistance(whole, p), 0.2 * 1.3e-3);
  }
}

// No surface point is nearer than the distance, and some sampled one is nearly as near.
TEST(GraftedSolid, InteriorDistanceIsTheDistanceToTheBareSurface) {
  Primitive graft = Cylinder({0.1, 0.05, 0}, 0.08, 0.35);
  graft.axes = Eigen::AngleAxisd(1.2, Vector3d(1, 1, 0.2).normalized()).matrix();
  const std::vector<Primitive> parts = {Cylinder(Vector3d::Zero(), 0.15, 0.35), graft,
                                        Box({0, 0, 0.1}, {0.3, 0.1, 0.12})};
  const GraftedSolid solid(parts);
  RngStream rng(4, "surface");
  std::vector<Vector3d>
      surface;  // inside points pushed to a part's surface, the buried ones dropped
  while (surface.size() < 40'000) {
    const Vector3d p = RandomPoint(rng, 0.5);
    for (const Primitive& part : parts) {
      if (SignedDistance(part, p) <= 0.0) continue;
      const Vector3d q = NearestFromInside(part, p);
      bool buried = false;
      for (const Primitive& other : parts) buried = buried || SignedDistance(other, q) > 1e-9;
      if (!buried) surface.push_back(q);
    }
  }
  int deep = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vector3d p = RandomPoint(rng, 0.18);
    double lower_bound = -1.0, nearest = std::numeric_limits<double>::infinity();
    for (const Primitive& part : parts) {
      lower_bound = std::max(lower_bound, SignedDistance(part, p));
    }
    if (lower_bound <= 0.0) continue;
    for (const Vector3d& q : surface) nearest = std::min(nearest, (q - p).norm());
    const double distance = solid.SignedDistance(p);
    EXPECT_GE(distance, lower_bound);
    EXPECT_LE(distance, nearest + 1e-12);
    EXPECT_GE(distance, nearest - 0.012);  // samples are about 0.01 apart
    deep += distance > lower_bound + 0.005;
  }
  EXPECT_GT(deep, 10);  // the correction was at work
}

TEST(GraftedSolid, OutsideTheNearestPartDecides) {
  const std::vector<Primitive> parts = {Box({-0.2, 0, 0}, {0.1, 0.1, 0.1}),
                                        Cylinder({0.2, 0, 0}, 0.1, 0.3)};
  const GraftedSolid solid(parts);
  EXPECT_DOUBLE_EQ(solid.SignedDistance({0, 0, 0}), -0.1);
  EXPECT_DOUBLE_EQ(solid.SignedDistance({0.4, 0, 0}), -0.1);
  EXPECT_LT((solid.Bounds().max - Vector3d(0.3, 0.1, 0.3)).norm(), 1e-15);
}

}  // namespace
}  // namespace antigrasp
