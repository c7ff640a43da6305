#include "antigrasp/similarity/roughness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

// Twelve edges of 1 at 90 degrees, six flat diagonals of sqrt(2).
constexpr double kCube = 12.0 * 90.0 / (12.0 + 6.0 * 1.4142135623730951);

TEST(MeanDihedralAngle, OfACubeIsByHand) {
  EXPECT_NEAR(MeanDihedralAngle(shapes::Cube()), kCube, 1e-9);
  EXPECT_NEAR(MeanDihedralAngle(shapes::Box({7, 7, 7})), kCube, 1e-9);
}

TEST(MeanDihedralAngle, OfARegularTetrahedronIsItsOuterAngle) {
  TriangleMesh mesh = shapes::Tetrahedron();
  mesh.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  EXPECT_NEAR(MeanDihedralAngle(mesh), 180.0 - std::acos(1.0 / 3.0) * 180.0 / M_PI, 1e-9);
}

TEST(MeanDihedralAngle, IsThatOfTheInvertedMeshAndOfOneFaceTurned) {
  TriangleMesh cube = shapes::Cube();
  EXPECT_NEAR(MeanDihedralAngle(shapes::Inverted(cube)), kCube, 1e-9);
  std::swap(cube.faces[3][0], cube.faces[3][1]);
  EXPECT_NEAR(MeanDihedralAngle(cube), kCube, 1e-9);
}

TEST(MeanDihedralAngle, FallsByHalfWithASphereTwiceAsFine) {
  const double coarse = MeanDihedralAngle(shapes::Sphere(1.0, 3));
  const double fine = MeanDihedralAngle(shapes::Sphere(1.0, 4));
  EXPECT_NEAR(coarse / fine, 2.0, 0.02);
}

TEST(MeanDihedralAngle, OfNothingFlatOrDegenerateIsZero) {
  EXPECT_EQ(MeanDihedralAngle({}), 0.0);
  EXPECT_EQ(MeanDihedralAngle(shapes::FlatSquare()), 0.0);
  TriangleMesh needle = shapes::Tetrahedron();
  for (auto& vertex : needle.vertices) vertex = {vertex.x(), 0, 0};
  EXPECT_EQ(MeanDihedralAngle(needle), 0.0);
}

}  // namespace
}  // namespace antigrasp
