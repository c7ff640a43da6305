#include "antigrasp/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(TriangleMesh, SphereVolumeAndAreaConvergeToTheFormulas) {
  double last_volume_error = 1e9, last_area_error = 1e9;
  for (int subdivisions = 1; subdivisions <= 5; ++subdivisions) {
    const TriangleMesh sphere = shapes::Sphere(2.0, subdivisions);
    const double volume_error = 4.0 / 3.0 * kPi * 8.0 - Volume(sphere);
    const double area_error = 4.0 * kPi * 4.0 - SurfaceArea(sphere);
    // Inscribed, and second order: four times better per subdivision.
    EXPECT_GT(volume_error, 0.0);
    EXPECT_GT(area_error, 0.0);
    EXPECT_LT(volume_error, last_volume_error / 3.0);
    EXPECT_LT(area_error, last_area_error / 3.0);
    last_volume_error = volume_error;
    last_area_error = area_error;
  }
  EXPECT_LT(last_volume_error, 0.05);
}

TEST(TriangleMesh, PrismsHaveTheirExactVolumeAndArea) {
  const TriangleMesh box = shapes::Box({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(Volume(box), 6.0);
  EXPECT_DOUBLE_EQ(SurfaceArea(box), 22.0);
  EXPECT_DOUBLE_EQ(Volume(shapes::Tetrahedron()), 1.0 / 6.0);
  const double polygon_area = 0.5 * 12 * std::sin(2.0 * kPi / 12) * 0.25;
  EXPECT_NEAR(Volume(shapes::Cylinder(0.5, 2.0, 12)), 2.0 * polygon_area, 1e-14);
}

TEST(TriangleMesh, TorusVolumeApproachesThatOfPappus) {
  EXPECT_NEAR(Volume(shapes::Torus(1.0, 0.3, 200, 100)), 2.0 * kPi * kPi * 0.09, 0.002);
}

TEST(TriangleMesh, TurningTheWindingNegatesTheVolume) {
  const TriangleMesh torus = shapes::Torus(1.0, 0.3, 20, 12);
  EXPECT_DOUBLE_EQ(Volume(shapes::Inverted(torus)), -Volume(torus));
  EXPECT_DOUBLE_EQ(SurfaceArea(shapes::Inverted(torus)), SurfaceArea(torus));
}

TEST(TriangleMesh, IntegralsFollowARigidMotion) {
  const Eigen::Vector3d shift(10.0, -20.0, 3.0);
  const TriangleMesh tetrahedron = shapes::Tetrahedron();
  const TriangleMesh moved = Transformed(tetrahedron, 2.0, shift);
  EXPECT_NEAR(Volume(moved), 8.0 / 6.0, 1e-12);
  EXPECT_TRUE(CenterOfMass(moved).isApprox(Eigen::Vector3d::Constant(0.5) + shift, 1e-14));
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const TriangleMesh turned = shapes::Rotated(tetrahedron, rotation);
  EXPECT_NEAR(Volume(turned), 1.0 / 6.0, 1e-15);
  EXPECT_TRUE(CenterOfMass(turned).isApprox(rotation * Eigen::Vector3d::Constant(0.25), 1e-14));
}

TEST(TriangleMesh, VolumeKeepsItsDigitsFarFromTheOrigin) {
  // Coordinates of 20 binary places, so that the shift rounds nothing.
  TriangleMesh home = shapes::Sphere(1.0, 1);
  home.vertices[0] *= 1.5;
  for (Eigen::Vector3d& v : home.vertices) v = (v * 0x1p20).array().round() * 0x1p-20;
  const Eigen::Vector3d shift(0x1p30, -0x1p29, 0x1p30);
  const TriangleMesh far = Transformed(home, 1.0, shift);
  EXPECT_NEAR(Volume(far), Volume(home), 1e-13);
  EXPECT_LT((CenterOfMass(far) - shift - CenterOfMass(home)).norm(), 1e-6);  // 2^-23 apart there
}

TEST(TriangleMesh, CenterOfMassWeighsSolidsByVolume) {
  // Volumes 1 and 8, centres 0 and 9.
  const TriangleMesh pair = shapes::Joined(
      shapes::Cube(), Transformed(shapes::Cube(), 2.0, Eigen::Vector3d(9.0, 0.0, 0.0)));
  EXPECT_NEAR(CenterOfMass(pair).x(), 8.0, 1e-13);
}

TEST(TriangleMesh, CenterOfMassOfASurfaceWithoutVolumeIsItsCentroid) {
  const TriangleMesh square = Transformed(shapes::FlatSquare(), 1.0, {3.0, 4.0, 5.0});
  EXPECT_TRUE(CenterOfMass(square).isApprox(Eigen::Vector3d(3.0, 4.0, 5.0), 1e-15));
}

TEST(TriangleMesh, BoundsAreTightAndZeroForNothing) {
  const BoundingBox box = Bounds(Transformed(shapes::Box({1, 2, 3}), 1.0, {1.0, 1.0, 1.0}));
  EXPECT_EQ(box.min, Eigen::Vector3d(0.5, 0.0, -0.5));
  EXPECT_EQ(box.max, Eigen::Vector3d(1.5, 2.0, 2.5));
  EXPECT_EQ(box.Center(), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(Bounds(TriangleMesh{}).Extent(), Eigen::Vector3d::Zero());
  EXPECT_EQ(Volume(TriangleMesh{}), 0.0);
  EXPECT_EQ(CenterOfMass(TriangleMesh{}), Eigen::Vector3d::Zero());
}

TEST(TriangleMesh, AFacesCrossIsTwiceItsAreaOnItsLeftHandSide) {
  // (2, 0, 0) x (0, 3, 0) = (0, 0, 6); and a face on no axis: (1, 2, 0) x (0, 1, 3) = (6, -3, 1).
  const TriangleMesh mesh{{{1, 1, 1}, {3, 1, 1}, {1, 4, 1}, {2, 3, 1}, {1, 2, 4}},
                          {{{0, 1, 2}, {0, 3, 4}}}};
  EXPECT_EQ(FaceCross(mesh, 0), Eigen::Vector3d(0, 0, 6));
  EXPECT_EQ(FaceCross(mesh, 1), Eigen::Vector3d(6, -3, 1));
  EXPECT_DOUBLE_EQ(SurfaceArea(mesh), 0.5 * (6.0 + std::sqrt(46.0)));
}

TEST(TriangleMesh, TransformedScalesAboutTheOriginThenMoves) {
  const TriangleMesh moved = Transformed({{{1, 2, 3}}, {}}, 2.0, {10.0, 20.0, 40.0});
  EXPECT_EQ(moved.vertices[0], Eigen::Vector3d(12, 24, 46));
  EXPECT_EQ(Bounds(moved).min, Bounds(moved).max);
}

// Volume 6 at the origin, volume 2 at (10, 4, -8): a quarter of the way. By area, 22 and 10, or by
// vertices it would be elsewhere.
TEST(TriangleMesh, CenterOfMassIsThatOfTheSolid) {
  const TriangleMesh pair =
      shapes::Joined(shapes::Box({1, 2, 3}), Transformed(shapes::Box({2, 1, 1}), 1.0, {10, 4, -8}));
  EXPECT_TRUE(CenterOfMass(pair).isApprox(Eigen::Vector3d(2.5, 1.0, -2.0), 1e-14));
  // An open sheet of two squares, areas 1 and 4, has the middle of its area.
  const TriangleMesh sheet = shapes::Joined(
      shapes::FlatSquare(), Transformed(shapes::FlatSquare(), 2.0, {5.0, 10.0, 0.0}));
  EXPECT_TRUE(CenterOfMass(sheet).isApprox(Eigen::Vector3d(4.0, 8.0, 0.0), 1e-14));
}

// A corner of legs 1, 1 and h is a solid, with its mass at a quarter, until nothing but rounding is
// left of its volume; then it is a sheet, with its area at a third.
TEST(TriangleMesh, AThinSolidIsStillASolid) {
  const auto center = [](double h) {
    TriangleMesh corner = shapes::Tetrahedron();
    corner.vertices[3].z() = h;
    return CenterOfMass(corner);
  };
  EXPECT_TRUE(center(1e-6).isApprox(Eigen::Vector3d(0.25, 0.25, 0.25e-6), 1e-6));
  EXPECT_TRUE(center(1e-11).isApprox(Eigen::Vector3d(0.25, 0.25, 0.25e-11), 1e-4));
  EXPECT_NEAR(center(1e-13).x(), 1.0 / 3, 1e-9);
}

}  // namespace
}  // namespace antigrasp
