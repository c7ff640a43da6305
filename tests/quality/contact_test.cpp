#include "antigrasp/quality/contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/random_draws.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(TangentFrame, IsRightHandedAndOrthonormal) {
  RngStream rng(1, "tangent");
  for (int i = 0; i < 1000; ++i) {
    const Vector3d d = DrawDirection(&rng);
    const auto [t1, t2] = TangentFrame(d);
    EXPECT_NEAR(t1.norm(), 1.0, 1e-14);
    EXPECT_NEAR(t1.dot(d), 0.0, 1e-14);
    EXPECT_LT((t1.cross(t2) - d).norm(), 1e-14);
  }
}

TEST(TangentFrame, FirstTangentHasTheLargestXPartOfAllTangents) {
  RngStream rng(2, "tangent");
  for (int i = 0; i < 50; ++i) {
    const auto [t1, t2] = TangentFrame(DrawDirection(&rng));
    for (int k = 0; k < 360; ++k) {
      const double angle = std::numbers::pi * k / 180.0;
      EXPECT_LE((std::cos(angle) * t1 + std::sin(angle) * t2).x(), t1.x() + 1e-15);
    }
  }
}

TEST(TangentFrame, ParallelToXTakesTheBasisVectorOfTheSvd) {
  for (const double sign : {1.0, -1.0}) {
    const Vector3d d = sign * Vector3d::UnitX();
    const auto [t1, t2] = TangentFrame(d);
    EXPECT_EQ(t1, Vector3d::UnitY());
    EXPECT_EQ(t2, d.cross(Vector3d::UnitY()));
  }
}

TEST(TangentFrame, StaysOrthogonalNextToThePole) {
  for (const double tilt : {1e-4, 1e-7, 1e-9, 1e-11, 1e-13}) {
    const Vector3d d = Vector3d(1.0, 0.3 * tilt, tilt).normalized();
    const auto [t1, t2] = TangentFrame(d);
    EXPECT_NEAR(t1.dot(d), 0.0, 1e-15) << tilt;
    EXPECT_NEAR(t1.norm(), 1.0, 1e-14) << tilt;
    EXPECT_NEAR(t2.norm(), 1.0, 1e-14) << tilt;
  }
}

TEST(Slips, ExactlyOutsideTheFrictionCone) {
  const Vector3d d = Vector3d::UnitZ();
  const double limit = std::atan(0.5);
  for (const double around : {0.0, 1.0, 2.5}) {
    const auto tilted = [&](double angle) {
      return Vector3d(std::sin(angle) * std::cos(around), std::sin(angle) * std::sin(around),
                      std::cos(angle));
    };
    EXPECT_FALSE(Slips(d, tilted(0.0), 0.5));
    EXPECT_FALSE(Slips(d, tilted(limit - 1e-9), 0.5));
    EXPECT_TRUE(Slips(d, tilted(limit + 1e-9), 0.5));
  }
}

TEST(Slips, PushingFromTheWrongSideAlwaysSlipsUnlessItIsExactlyAlongTheNormal) {
  EXPECT_TRUE(Slips(Vector3d::UnitZ(), Vector3d(0.1, 0.0, -1.0).normalized(), 100.0));
  EXPECT_TRUE(Slips(Vector3d::UnitZ(), Vector3d::UnitX(), 100.0));
}

TEST(Slips, WithoutFrictionOnlyTheNormalDirectionHolds) {
  EXPECT_FALSE(Slips(Vector3d::UnitZ(), Vector3d::UnitZ(), 0.0));
  EXPECT_TRUE(Slips(Vector3d::UnitZ(), Vector3d(1e-6, 0.0, 1.0).normalized(), 0.0));
}

}  // namespace
}  // namespace antigrasp
