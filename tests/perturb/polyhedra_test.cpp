#include "antigrasp/perturb/polyhedra.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/mesh/inspect.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

PolyhedronOptions Options(double phi) {
  PolyhedronOptions options;
  options.phi = phi;
  options.restarts = 1;
  options.moves = 25;
  return options;
}

TEST(SmallestAntipodality, IsKnownForTheRegularSolids) {
  const double expected[] = {0.0, std::acos(1.0 / 3.0) / kDegree, 0.0, 0.0, 0.0, 0.0};
  for (int kind = 0; kind < 6; ++kind) {
    const TriangleMesh mesh = PlainPolyhedron(static_cast<Polyhedron>(kind), 2.0);
    EXPECT_NEAR(SmallestAntipodality(mesh).degrees, expected[kind], 1e-7)
        << ChoiceNames<Polyhedron>()[static_cast<std::size_t>(kind)];
  }
  EXPECT_EQ(SmallestAntipodality(shapes::Cube()).degrees, 0.0);
  EXPECT_NEAR(kBestAntipodality, expected[1], 1e-12);
}

TEST(SmallestAntipodality, NamesThePairAndLeavesOutFacesWithoutArea) {
  TriangleMesh mesh = shapes::Tetrahedron();  // three faces at right angles and a slanted one
  const Antipodality antipodality = SmallestAntipodality(mesh);
  EXPECT_NEAR(antipodality.degrees, std::acos(1.0 / std::sqrt(3.0)) / kDegree, 1e-12);
  EXPECT_EQ(antipodality.second, 3u);
  // Pulled up the slope is nearest to the bottom, face 0.
  TriangleMesh flat = mesh;
  flat.vertices[3].z() = 0.5;
  EXPECT_EQ(SmallestAntipodality(flat).first, 0u);
  EXPECT_EQ(SmallestAntipodality(flat).second, 3u);
  EXPECT_NEAR(SmallestAntipodality(flat).degrees, std::acos(2.0 / std::sqrt(6.0)) / kDegree,
              1e-12);  // slope along (1, 1, 2)
  mesh.faces.push_back({0, 1, 1});
  EXPECT_EQ(SmallestAntipodality(mesh).degrees, antipodality.degrees);
  EXPECT_EQ(SmallestAntipodality({}).degrees, 180.0);
}

TEST(SmallestAntipodality, DoesNotChangeWhenTheObjectMoves) {
  const TriangleMesh cube = MakeAdversarialPolyhedron(Polyhedron::kCube, Options(20)).mesh;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(3, 1, -2).normalized()).toRotationMatrix();
  const TriangleMesh moved = Transformed(shapes::Rotated(cube, turn), 0.01, Vector3d(5, -7, 1));
  EXPECT_NEAR(SmallestAntipodality(moved).degrees, SmallestAntipodality(cube).degrees, 1e-9);
  EXPECT_TRUE(IsConvex(moved));
}

TEST(SmallestAntipodality, OfABallIsThatOfItsFacetsAndOfNoSolidAboveTheTetrahedrons) {
  EXPECT_NEAR(SmallestAntipodality(shapes::Sphere(1.0, 2)).degrees, 0.0, 1e-9);
  EXPECT_LE(SmallestAntipodality(shapes::Tetrahedron()).degrees, kBestAntipodality);
}

TEST(PlainPolyhedron, HasItsNameInTheOrderOfTheEnumeration) {
  // The numbers of faces; the cube's are halves of squares.
  const std::pair<const char*, std::size_t> expected[] = {
      {"cube", 12},          {"tetrahedron", 4},   {"octahedron", 8},
      {"cuboctahedron", 20}, {"dodecahedron", 36}, {"icosahedron", 20}};
  ASSERT_EQ(ChoiceNames<Polyhedron>().size(), std::size(expected));
  for (int kind = 0; kind < 6; ++kind) {
    const auto& [name, faces] = expected[kind];
    EXPECT_EQ(ChoiceNames<Polyhedron>()[static_cast<std::size_t>(kind)], name);
    EXPECT_EQ(PlainPolyhedron(static_cast<Polyhedron>(kind), 1.0).faces.size(), faces) << name;
  }
  PolyhedronOptions options;
  OptionTable table;
  Bind(&table, &options);
  table.ApplyOverride("shape.restarts=7");
  table.ApplyOverride("shape.moves=9");
  EXPECT_EQ(options.restarts, 7);
  EXPECT_EQ(options.moves, 9);
}

TEST(PlainPolyhedron, FillsItsCubeAndIsAConvexSolid) {
  const std::size_t corners[] = {8, 4, 6, 12, 20, 12};
  for (int kind = 0; kind < 6; ++kind) {
    const TriangleMesh mesh = PlainPolyhedron(static_cast<Polyhedron>(kind), 30.0);
    EXPECT_EQ(mesh.vertices.size(), corners[kind]);
    EXPECT_NEAR((Bounds(mesh).Extent() - Vector3d::Constant(30)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(Bounds(mesh).Center().norm(), 0.0, 1e-12);
    EXPECT_TRUE(Inspect(mesh).IsSolid()) << WhyNotSolid(Inspect(mesh));
    EXPECT_TRUE(IsConvex(mesh));
    const double radius = mesh.vertices.front().norm();
    for (const Vector3d& v : mesh.vertices) EXPECT_NEAR(v.norm(), radius, 1e-12);
  }
}

TEST(AdversarialCube, HasThePapersPyramidsAndTheirAngle) {
  for (const double phi : {10.0, 15.0, 26.0, 30.0}) {
    const auto cube = MakeAdversarialPolyhedron(Polyhedron::kCube, Options(phi));
    ASSERT_TRUE(cube.reached) << phi;
    EXPECT_NEAR(cube.antipodality.degrees, phi, 1e-5);
    EXPECT_EQ(cube.mesh.vertices.size(), 11u);
    EXPECT_EQ(cube.mesh.faces.size(), 18u);
    EXPECT_TRUE(Inspect(cube.mesh).IsSolid());
    EXPECT_TRUE(IsConvex(cube.mesh));
    const double height = 0.5 * std::tan(phi * kDegree);
    EXPECT_NEAR(cube.largest_move, height, 1e-12);
    EXPECT_NEAR(cube.rms_move, height * std::sqrt(3.0 / 11.0), 1e-12);
    // The cube and three pyramids of a third of base times height.
    EXPECT_NEAR(Inspect(cube.mesh).volume, 40.0 * 40.0 * 40.0 * (1.0 + height), 0.1);
    EXPECT_NEAR(Bounds(cube.mesh).max.x(), 20.0 + 40.0 * height, 1e-5);
    EXPECT_NEAR((Bounds(cube.mesh).max - Vector3d::Constant(20.0 + 40.0 * height)).norm(), 0, 1e-5);
    EXPECT_EQ(Bounds(cube.mesh).min, Vector3d::Constant(-20.0));
  }
}

TEST(AdversarialCube, ReachesThirtyDegreesAndNoMore) {
  const auto cube = MakeAdversarialPolyhedron(Polyhedron::kCube, Options(31));
  EXPECT_FALSE(cube.reached);
  EXPECT_NEAR(cube.antipodality.degrees, 30.0, 1e-5);
}

TEST(AdversarialPolyhedron, ReachesTheAngleWithoutConcavities) {
  for (const Polyhedron kind : {Polyhedron::kOctahedron, Polyhedron::kCuboctahedron,
                                Polyhedron::kDodecahedron, Polyhedron::kIcosahedron}) {
    for (const double phi : {10.0, 26.0}) {
      if (kind == Polyhedron::kDodecahedron && phi < 26.0) continue;  // most corners: 1 s each
      const auto solid = MakeAdversarialPolyhedron(kind, Options(phi));
      EXPECT_TRUE(solid.reached);
      EXPECT_GE(SmallestAntipodality(solid.mesh).degrees, phi);
      EXPECT_LT(solid.antipodality.degrees, phi + 0.1);  // moved no further than needed
      EXPECT_TRUE(Inspect(solid.mesh).IsSolid()) << WhyNotSolid(Inspect(solid.mesh));
      EXPECT_TRUE(IsConvex(solid.mesh));
      EXPECT_EQ(solid.mesh.vertices.size(), PlainPolyhedron(kind, 1).vertices.size());
      // Opposite faces turn by about phi / 2 each.
      EXPECT_LT(solid.rms_move, 0.6 * phi * kDegree);
      EXPECT_LE(solid.rms_move, solid.largest_move);
    }
  }
}

TEST(AdversarialPolyhedron, IsThePlainSolidWhenThatWillDo) {
  const auto tetrahedron = MakeAdversarialPolyhedron(Polyhedron::kTetrahedron, Options(70));
  EXPECT_TRUE(tetrahedron.reached);
  EXPECT_EQ(tetrahedron.largest_move, 0.0);
  const auto plain = MakeAdversarialPolyhedron(Polyhedron::kIcosahedron, Options(0));
  EXPECT_TRUE(plain.reached);
  EXPECT_EQ(plain.rms_move, 0.0);
}

TEST(AdversarialPolyhedron, SaysHowFarItCameWhenTheAngleIsOutOfReach) {
  PolyhedronOptions options = Options(75);  // of no solid
  options.moves = 5;
  const auto solid = MakeAdversarialPolyhedron(Polyhedron::kCuboctahedron, options);
  EXPECT_FALSE(solid.reached);
  EXPECT_GT(solid.antipodality.degrees, 10.0);
  EXPECT_LE(solid.antipodality.degrees, kBestAntipodality);
}

TEST(AdversarialPolyhedron, MovesAreSharesOfTheSize) {
  PolyhedronOptions options = Options(15);
  options.size = 7.0;
  options.moves = 10;
  const auto solid = MakeAdversarialPolyhedron(Polyhedron::kOctahedron, options);
  const TriangleMesh plain = PlainPolyhedron(Polyhedron::kOctahedron, 7.0);
  double largest = 0.0, squares = 0.0;
  for (const Vector3d& corner : plain.vertices) {
    double nearest = 1e9;  // corners move by far less than half of the way to the next
    for (const Vector3d& v : solid.mesh.vertices) nearest = std::min(nearest, (v - corner).norm());
    largest = std::max(largest, nearest);
    squares += nearest * nearest;
  }
  EXPECT_GT(largest, 0.1);
  EXPECT_NEAR(solid.largest_move, largest / 7.0, 1e-6);
  EXPECT_NEAR(solid.rms_move, std::sqrt(squares / 6.0) / 7.0, 1e-6);
}

TEST(AdversarialPolyhedron, EverySearchHasNumbersOfItsOwnAndTheBestWins) {
  PolyhedronOptions options = Options(15);
  options.moves = 6;
  int better = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    options.seed = seed;
    options.restarts = 1;
    const auto one = MakeAdversarialPolyhedron(Polyhedron::kOctahedron, options, 1);
    options.restarts = 3;
    const auto three = MakeAdversarialPolyhedron(Polyhedron::kOctahedron, options, 1);
    ASSERT_TRUE(one.reached && three.reached);
    EXPECT_LE(three.rms_move, one.rms_move);
    better += three.rms_move < one.rms_move ? 1 : 0;
  }
  EXPECT_GT(better, 0);
}

TEST(IsConvex, KnowsADentOfTheMeshsOwnSize) {
  EXPECT_TRUE(IsConvex(shapes::Box({1, 2, 3})));
  EXPECT_TRUE(IsConvex(shapes::Tetrahedron()));
  EXPECT_FALSE(IsConvex(shapes::Torus(1.0, 0.3, 12, 8)));
  TriangleMesh dented = shapes::Cylinder(1.0, 2.0, 16);
  dented.vertices[1].z() -= 1e-4;  // the middle of the upper cap
  EXPECT_FALSE(IsConvex(dented));
  EXPECT_FALSE(IsConvex(Transformed(dented, 1e-3, {5.0, 0.0, 0.0})));
}

TEST(AdversarialPolyhedron, DependsOnTheSeedAndNotOnTheThreads) {
  PolyhedronOptions options = Options(15);
  options.restarts = 3;
  options.moves = 5;
  const auto one = MakeAdversarialPolyhedron(Polyhedron::kOctahedron, options, 1);
  std::int64_t rounds = 0;
  const auto two = MakeAdversarialPolyhedron(
      Polyhedron::kOctahedron, options, 2,
      [&](std::int64_t done, std::int64_t total) { rounds = done == total ? done : rounds; });
  EXPECT_EQ(one.mesh.vertices, two.mesh.vertices);
  EXPECT_EQ(rounds, 10);
  options.seed = 2;
  const auto other = MakeAdversarialPolyhedron(Polyhedron::kOctahedron, options, 1);
  EXPECT_NE(one.mesh.vertices, other.mesh.vertices);
}

}  // namespace
}  // namespace antigrasp
