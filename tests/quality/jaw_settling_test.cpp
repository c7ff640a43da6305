#include "antigrasp/quality/jaw_settling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/mesh/mass_properties.h"
#include "tests/support/contact_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kWideOpen = 0.05;

JawSettling::Grip CloseOn(const TriangleMesh& mesh, const Vector3d& offset, double friction,
                          const GripLoad& load = {}, TipShape shape = TipShape::kSphere) {
  const Vector3d com = ComputeMassProperties(mesh).center;
  double radius = 0.0;
  for (const Vector3d& vertex : mesh.vertices) radius = std::max(radius, (vertex - com).norm());
  Fingertip tip;
  tip.shape = shape;
  Isometry3d object = Isometry3d::Identity();
  object.translation() = offset - com;
  return JawSettling(com, radius, tip, load).Close(ContactSolid(mesh), object, kWideOpen, friction);
}

// Its sides lean by `half` degrees each: they meet above.
TriangleMesh Wedge(double half) {
  const double lean = 0.02 * std::tan(half * kDegree);
  return shapes::Extruded(
      {{-0.015 - lean, -0.02}, {0.015 + lean, -0.02}, {0.015 - lean, 0.02}, {-0.015 + lean, 0.02}},
      {{{0, 1, 2}}, {{0, 2, 3}}}, 0.04);
}

TEST(JawSettling, ABoxBetweenTheJawsStaysWhereItIs) {
  const auto grip = CloseOn(shapes::Box({0.03, 0.04, 0.05}), Vector3d::Zero(), 0.3);
  EXPECT_TRUE(grip.closed);
  EXPECT_TRUE(grip.held);
  EXPECT_LT(grip.object.translation().norm(), 5e-5);
}

TEST(JawSettling, TheJawThatComesFirstPushesTheObjectToTheOther) {
  const auto grip = CloseOn(shapes::Box({0.03, 0.04, 0.05}), {0.004, 0.0, 0.0}, 0.3);
  EXPECT_TRUE(grip.held);
  EXPECT_LT(std::abs(grip.object.translation().x()), 1e-4);
}

// Two faces that lean by half an angle each can be pinched when that is less than the friction
// angle: the weight of a light body takes little of it.
TEST(JawSettling, AWedgeIsSqueezedOutWhenItLeansMoreThanTheFrictionAngle) {
  const GripLoad light{0.001, 15.0};
  for (const double half : {5.0, 10.0, 14.0}) {
    const double below = std::tan((half - 1.0) * kDegree), above = std::tan((half + 1.0) * kDegree);
    EXPECT_FALSE(CloseOn(Wedge(half), Vector3d::Zero(), below, light).held) << half;
    EXPECT_TRUE(CloseOn(Wedge(half), Vector3d::Zero(), above, light).held) << half;
  }
}

// Turned by some degrees a box is outside the cones at the first touch, and is turned straight.
TEST(JawSettling, WhatSlipsAtTheFirstTouchMayBeCaught) {
  const TriangleMesh box = shapes::Box({0.03, 0.06, 0.06});
  const Vector3d com = Vector3d::Zero();
  Isometry3d object = Isometry3d::Identity();
  object.linear() = Eigen::AngleAxisd(8.0 * kDegree, Vector3d::UnitZ()).toRotationMatrix();
  const auto grip = JawSettling(com, 0.05, {}, {})
                        .Close(ContactSolid(box), object, kWideOpen, std::tan(4 * kDegree));
  EXPECT_TRUE(grip.held);
  const double left = std::asin(grip.object.linear()(1, 0)) / kDegree;
  EXPECT_LT(std::abs(left), 4.5);  // inside the friction angle now
}

TEST(JawSettling, AFlatGripBearsTwiceFrictionTimesForce) {
  const double friction = 0.4, force = 15.0;
  const auto bears = [&](double share) {
    const double mass = share * 2.0 * friction * force / 9.81;
    return CloseOn(shapes::Box({0.03, 0.04, 0.04}), Vector3d::Zero(), friction, {mass, force}).held;
  };
  EXPECT_TRUE(bears(0.8));
  EXPECT_FALSE(bears(1.5));
}

// Only the weight over the force counts.
TEST(JawSettling, TenTimesTheWeightAndTheForceAreTheSame) {
  const TriangleMesh mesh = shapes::Bumpy(0.018, 3, 5);
  for (int i = 0; i < 12; ++i) {
    const Vector3d offset(0.001 * (i % 3), 0.002 * (i - 6), 0.001 * (i % 4));
    const auto a = CloseOn(mesh, offset, 0.2, {0.05, 15.0});
    const auto b = CloseOn(mesh, offset, 0.2, {0.5, 150.0});
    EXPECT_EQ(a.held, b.held);
    EXPECT_LT((a.object.translation() - b.object.translation()).norm(), 1e-9);
  }
}

TEST(JawSettling, JawsThatMeetNothingHoldNothing) {
  const auto grip = CloseOn(shapes::Box({0.03, 0.02, 0.02}), {0.0, 0.05, 0.0}, 0.5);
  EXPECT_FALSE(grip.closed);
  EXPECT_FALSE(grip.held);
  EXPECT_EQ(grip.steps, 0);
}

// A ball's torsion is 2/3 of its patch; a pad's arm is half its size: on a box that hangs far to
// one side the pad holds what the ball lets turn. Neither drops it.
TEST(JawSettling, APadKeepsABoxFromTurningThatTurnsAboutBalls) {
  const TriangleMesh box = shapes::Box({0.03, 0.03, 0.2});
  const GripLoad heavy{0.3, 15.0};
  const Vector3d aside(0.0, 0.0, 0.08);
  const auto turn = [&](TipShape shape) {
    const auto grip = CloseOn(box, aside, 0.5, heavy, shape);
    return Eigen::AngleAxisd(Eigen::Matrix3d(grip.object.linear())).angle();
  };
  EXPECT_GT(turn(TipShape::kSphere), 1.0 * kDegree);
  EXPECT_LT(turn(TipShape::kPad), 0.5 * kDegree);
}

}  // namespace
}  // namespace antigrasp
