#include "antigrasp/datasets/roughness.h"

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

TEST(MeanDihedralAngle, WeighsEveryEdgeByItsLength) {
  // A box of 2 x 3 x 6 has four right edges of each length and two flat diagonals on each pair of
  // sides.
  const double right = 4 * (2 + 3 + 6);
  const double flat = 2 * (std::sqrt(4.0 + 9) + std::sqrt(4.0 + 36) + std::sqrt(9.0 + 36));
  EXPECT_NEAR(MeanDihedralAngle(shapes::Box({2, 3, 6})), 90 * right / (right + flat), 1e-9);
}

// Three unit squares in a row, `up` degrees bent up at one seam and `down` degrees down at the
// other: two seams of 1 and three diagonals of sqrt(2) between two faces each.
TriangleMesh Strip(double up, double down) {
  TriangleMesh strip;
  double x = 0.0, z = 0.0, angle = 0.0;
  for (const double turn : {0.0, up, -down, 0.0}) {
    strip.vertices.insert(strip.vertices.end(), {{x, 0, z}, {x, 1, z}});
    angle += turn * M_PI / 180.0;
    x += std::cos(angle);
    z += std::sin(angle);
  }
  for (std::int32_t i = 0; i < 6; i += 2) {
    strip.faces.insert(strip.faces.end(), {{i, i + 2, i + 3}, {i, i + 3, i + 1}});
  }
  return strip;
}

TEST(MeanDihedralAngle, OfBendsUpAndDownIsTheirSum) {
  EXPECT_NEAR(MeanDihedralAngle(Strip(60, 30)), 90 / (2 + 3 * std::sqrt(2.0)), 1e-9);
  EXPECT_NEAR(MeanDihedralAngle(Strip(150, 120)), 270 / (2 + 3 * std::sqrt(2.0)), 1e-9);
}

TEST(DihedralAngles, AreSharesOfTheEdgesLengthBelowTwoAndAboveThirtyDegrees) {
  const double length = 2 + 3 * std::sqrt(2.0), seam = 1 / length;
  const auto strip = [](double up, double down) { return DihedralAnglesOf(Strip(up, down)); };
  EXPECT_NEAR(strip(1.99, 30.01).flat, 1 - seam, 1e-9);
  EXPECT_NEAR(strip(1.99, 30.01).crease, seam, 1e-9);
  EXPECT_NEAR(strip(2.01, 29.99).flat, 1 - 2 * seam, 1e-9);
  EXPECT_EQ(strip(2.01, 29.99).crease, 0.0);
  const DihedralAngles cube = DihedralAnglesOf(shapes::Cube());
  EXPECT_NEAR(cube.flat, 1 - kCube / 90, 1e-9);
  EXPECT_NEAR(cube.crease, kCube / 90, 1e-9);
}

TEST(DihedralAngles, SpreadOverTheStepsWithTheirMean) {
  const DihedralAngles strip = DihedralAnglesOf(Strip(20.1, 179.9));
  double sum = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < strip.spread.size(); ++i) {
    sum += strip.spread[i];
    mean += DihedralAngles::kStep * static_cast<double>(i) * strip.spread[i];
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(mean, 200 / (2 + 3 * std::sqrt(2.0)), 1e-9);
  // 20.1 lies two fifths of a step above 20.
  EXPECT_NEAR(strip.spread[80] / strip.spread[81], 3.0 / 2, 1e-6);
  for (const double none : DihedralAnglesOf({}).spread) EXPECT_EQ(none, 0.0);
}

TEST(DihedralDistance, IsHowFarAnglesMoveByTheShareThatMoves) {
  const double seam = 1 / (2 + 3 * std::sqrt(2.0));
  const auto apart = [](const TriangleMesh& a, const TriangleMesh& b) {
    return DihedralDistance(DihedralAnglesOf(a), DihedralAnglesOf(b));
  };
  EXPECT_NEAR(apart(Strip(10, 40), Strip(25, 40)), 15 * seam, 1e-9);
  EXPECT_NEAR(apart(Strip(25, 40), Strip(10, 40)), 15 * seam, 1e-9);
  EXPECT_NEAR(apart(Strip(10, 40), Strip(40, 10)), 0.0, 1e-9);        // the edges' order is nothing
  EXPECT_NEAR(apart(Strip(10, 40), Strip(45, 50)), 45 * seam, 1e-9);  // 10 to 45, or to 50
  EXPECT_NEAR(apart(Strip(0, 90), Strip(0.1, 90)), 0.1 * seam, 1e-9);  // within a step
}

TEST(DihedralDistance, OfSetsWeighsEveryShapeAlike) {
  // A cube a thousand times as large, and one cut finer, count as much as a small one.
  const DihedralAngles cube = DihedralAnglesOf(shapes::Cube()),
                       large = DihedralAnglesOf(Transformed(shapes::Cube(), 1000.0, {0, 0, 0})),
                       square = DihedralAnglesOf(shapes::FlatSquare());
  const DihedralAngles half = MeanOf({square, large});
  EXPECT_NEAR(half.flat, 1 - 0.5 * kCube / 90, 1e-9);
  EXPECT_NEAR(half.crease, 0.5 * kCube / 90, 1e-9);
  EXPECT_NEAR(DihedralDistance(half, MeanOf({cube, cube, square, square})), 0.0, 1e-9);
  EXPECT_NEAR(DihedralDistance(half, MeanOf({cube})), 0.5 * kCube, 1e-9);
  EXPECT_THROW(MeanOf({}), std::logic_error);
}

TEST(MeanDihedralAngle, KeepsATinyAngle) {
  const double tiny = 1e-8;  // its cosine is 1
  EXPECT_NEAR(MeanDihedralAngle(Strip(tiny, 0)), tiny / (2 + 3 * std::sqrt(2.0)), 1e-6 * tiny);
}

TEST(MeanDihedralAngle, LeavesEdgesOfThreeFacesOut) {
  TriangleMesh fan = shapes::FlatSquare();  // one flat diagonal
  fan.vertices.emplace_back(0, 0, 1);
  fan.faces.push_back({fan.faces[0][0], fan.faces[0][1], 4});
  EXPECT_GT(MeanDihedralAngle(fan), 10.0);  // and one seam with a fin
  fan.vertices.emplace_back(0, 0, -1);
  fan.faces.push_back({fan.faces[0][0], fan.faces[0][1], 5});
  EXPECT_EQ(MeanDihedralAngle(fan), 0.0);
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
