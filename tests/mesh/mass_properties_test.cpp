#include "antigrasp/mesh/mass_properties.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// m / 12 (b^2 + c^2) and so on.
Matrix3d InertiaOfBox(const Vector3d& extents) {
  const Vector3d squares = extents.cwiseProduct(extents);
  const Vector3d moments = Vector3d::Constant(squares.sum()) - squares;
  return (extents.prod() / 12.0 * moments).asDiagonal();
}

TEST(MassProperties, AreThoseOfABoxWhereverItLies) {
  const Vector3d extents(1.0, 2.0, 3.0);
  const Vector3d place(1000.0, -2000.0, 3000.0);
  const MassProperties box = ComputeMassProperties(Transformed(shapes::Box(extents), 1.0, place));
  EXPECT_NEAR(box.volume, 6.0, 1e-9);
  EXPECT_LT((box.center - place).norm(), 1e-9);
  EXPECT_LT((box.inertia - InertiaOfBox(extents)).norm(), 1e-9);
}

TEST(MassProperties, TurnWithTheMesh) {
  const Vector3d extents(1.0, 2.0, 3.0);
  const Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
  const MassProperties box = ComputeMassProperties(shapes::Rotated(shapes::Box(extents), turn));
  const Matrix3d expected = turn * InertiaOfBox(extents) * turn.transpose();
  EXPECT_GT(std::abs(expected(0, 1)), 0.1);  // off the diagonal too
  EXPECT_LT((box.inertia - expected).norm(), 1e-12);
}

TEST(MassProperties, OfATetrahedronAreOffItsCorner) {
  const MassProperties corner = ComputeMassProperties(shapes::Tetrahedron());
  EXPECT_NEAR(corner.volume, 1.0 / 6.0, 1e-15);
  EXPECT_LT((corner.center - Vector3d::Constant(0.25)).norm(), 1e-15);
  // About the corner: integral of y^2 + z^2 = 2 / 60, of x y = 1 / 120; then to the centre of mass.
  const double diagonal = 1.0 / 30.0 - 2.0 / 16.0 / 6.0;
  const double product = -(1.0 / 120.0 - 1.0 / 16.0 / 6.0);
  EXPECT_NEAR(corner.inertia(1, 1), diagonal, 1e-15);
  EXPECT_NEAR(corner.inertia(0, 2), product, 1e-15);
}

TEST(MassProperties, OfAFineSphereApproachTheBalls) {
  const double r = 0.5;
  const MassProperties ball = ComputeMassProperties(shapes::Sphere(r, 4));
  const double volume = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  const double moment = 0.4 * volume * r * r;
  // An inscribed icosphere of 5,120 faces is 0.2 % smaller; its moments are of the fifth power.
  EXPECT_LT(ball.volume, volume);
  EXPECT_NEAR(ball.volume, volume, 0.003 * volume);
  EXPECT_LT(ball.inertia(0, 0), moment);
  EXPECT_NEAR(ball.inertia(0, 0), moment, 0.005 * moment);
  EXPECT_NEAR(ball.inertia(2, 2), moment, 0.005 * moment);
}

TEST(MassProperties, LeaveOutAVoid) {
  const Vector3d outside(4.0, 3.0, 2.0);
  const Vector3d inside(1.0, 2.0, 0.5);
  const MassProperties hollow = ComputeMassProperties(
      shapes::Joined(shapes::Box(outside), shapes::Inverted(shapes::Box(inside))));
  EXPECT_NEAR(hollow.volume, 23.0, 1e-12);
  EXPECT_LT((hollow.inertia - (InertiaOfBox(outside) - InertiaOfBox(inside))).norm(), 1e-12);
}

}  // namespace
}  // namespace antigrasp
