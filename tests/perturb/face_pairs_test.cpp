#include "antigrasp/perturb/face_pairs.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "antigrasp/core/angles.h"
#include "antigrasp/perturb/cone.h"
#include "antigrasp/perturb/validity.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/rippled_solid.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

std::vector<FacePair> ByAllPairs(const TriangleMesh& mesh, const PairLimits& limits) {
  const AntipodalTest test(limits);
  std::vector<FacePair> pairs;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.faces.size(); ++j) {
      if (test(FaceShape(mesh, i), FaceShape(mesh, j))) {
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      }
    }
  }
  return pairs;
}

PairLimits Cone(double radians) { return {radians, std::numeric_limits<double>::infinity()}; }

// Two parallel triangles that face away from each other, `height` apart, with a gap of `gap`
// between their shadows.
TriangleMesh Plates(double height, double gap) {
  return shapes::Triangles(
      {{Vector3d(0, 0, 0), Vector3d(-1, -2, 0), Vector3d(-1, 2, 0)},
       {Vector3d(gap, 0, height), Vector3d(gap + 1, -2, height), Vector3d(gap + 1, 2, height)}});
}

TEST(AntipodalityAngle, IsTheAngleByWhichOppositeFacesMissBeingParallel) {
  EXPECT_EQ(AntipodalityAngle(Vector3d::UnitX(), -Vector3d::UnitX()), 0.0);
  EXPECT_NEAR(AntipodalityAngle(Vector3d::UnitX(), Vector3d::UnitX()), std::numbers::pi, 1e-15);
  for (const double angle : {1e-9, 0.01, 0.5, 2.0}) {
    const Vector3d turned = -Vector3d(std::cos(angle), std::sin(angle), 0);
    EXPECT_NEAR(AntipodalityAngle(Vector3d::UnitX(), turned), angle, 1e-12 * angle + 1e-16);
  }
}

TEST(AntipodalTest, TwoPlatesAreAPairFromTheAngleOnAtWhichTheConeSpansTheGap) {
  for (const double gap : {0.1, 0.5, 1.0}) {
    const TriangleMesh mesh = Plates(2.0, gap);
    const double least = std::atan(gap / 2.0);
    const FaceShape a(mesh, 0), b(mesh, 1);
    ASSERT_LT(a.normal.z(), 0);
    EXPECT_FALSE(AntipodalTest(Cone(least - 1e-9))(a, b)) << gap;
    EXPECT_TRUE(AntipodalTest(Cone(least))(a, b)) << gap;
    EXPECT_TRUE(AntipodalTest(Cone(least + 1e-9))(b, a)) << gap;
  }
}

TEST(AntipodalTest, PlatesThatOverlapAreAPairWithoutFriction) {
  const TriangleMesh mesh = Plates(2.0, -0.5);
  EXPECT_TRUE(AntipodalTest(Cone(0.0))(FaceShape(mesh, 0), FaceShape(mesh, 1)));
  const TriangleMesh inverted = shapes::Inverted(mesh);  // they face each other: nothing between
  EXPECT_FALSE(AntipodalTest(Cone(1.0))(FaceShape(inverted, 0), FaceShape(inverted, 1)));
}

TEST(AntipodalTest, PlatesAtAnAngleNeedHalfOfItAtLeast) {
  // The second plate is turned about y, over the first one: the best direction is half-way.
  for (const double turn : {5 * kDegree, 30 * kDegree}) {
    TriangleMesh mesh = Plates(2.0, -1.0);
    const Eigen::AngleAxisd rotation(turn, Vector3d::UnitY());
    const Vector3d middle(-0.5, 0, 2);
    for (std::size_t v = 3; v < 6; ++v) {
      mesh.vertices[v] = middle + rotation * (mesh.vertices[v] - middle);
    }
    const FaceShape a(mesh, 0), b(mesh, 1);
    EXPECT_NEAR(AntipodalityAngle(a.normal, b.normal), turn, 1e-12);
    EXPECT_FALSE(AntipodalTest(Cone(0.5 * turn - 1e-9))(a, b));
    EXPECT_TRUE(AntipodalTest(Cone(0.5 * turn + 1e-9))(a, b));
  }
}

TEST(AntipodalTest, WidthIsTheShortestDistanceWithinTheCones) {
  const FaceShape a(Plates(2.0, 0.5), 0), b(Plates(2.0, 0.5), 1);
  const double corner_to_corner = std::hypot(2.0, 0.5);
  EXPECT_NEAR(AntipodalTest(Cone(0.5)).Width(a, b), corner_to_corner, 1e-12);
  EXPECT_FALSE(AntipodalTest({0.5, corner_to_corner - 1e-9})(a, b));
  EXPECT_TRUE(AntipodalTest({0.5, corner_to_corner + 1e-9})(a, b));
  EXPECT_EQ(AntipodalTest(Cone(0.1)).Width(a, b), std::numeric_limits<double>::infinity());
  const FaceShape over(Plates(3.0, -0.5), 1);
  EXPECT_NEAR(AntipodalTest(Cone(0.3)).Width(a, over), 3.0, 1e-12);
}

TEST(AntipodalTest, AgreesWithASearchOverPointsOfBothFaces) {
  RngStream rng(1, "pairs_search");
  const auto draw = [&] { return Vector3d(rng.Normal(), rng.Normal(), rng.Normal()); };
  static constexpr int kGrid = 14;
  int both = 0, narrow = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d apart(0, 0, rng.Uniform(0.0, 4.0));
    const FaceShape a(draw(), draw(), draw()), b(draw() + apart, draw() + apart, draw() + apart);
    const double psi = rng.Uniform(0.1, 0.9);
    const antigrasp::Cone inward(-a.normal, psi), outward(b.normal, psi);
    double found = std::numeric_limits<double>::infinity();
    const auto point = [](const FaceShape& f, int s, int t) {
      return Vector3d(f.corner[0] + (f.corner[1] - f.corner[0]) * s / kGrid +
                      (f.corner[2] - f.corner[0]) * t / kGrid);
    };
    for (int s = 0; s <= kGrid; ++s) {
      for (int t = 0; s + t <= kGrid; ++t) {
        for (int u = 0; u <= kGrid; ++u) {
          for (int v = 0; u + v <= kGrid; ++v) {
            const Vector3d d = point(b, u, v) - point(a, s, t);
            if (inward.Contains(d) && outward.Contains(d)) found = std::min(found, d.norm());
          }
        }
      }
    }
    const AntipodalTest test(Cone(psi));
    const double width = test.Width(a, b);
    EXPECT_EQ(test(a, b), std::isfinite(width)) << i;
    EXPECT_EQ(test(b, a), test(a, b)) << i;
    EXPECT_TRUE(test.Width(b, a) == width || std::abs(test.Width(b, a) - width) < 1e-9) << i;
    // The grid is a subset: never better, and near the optimum where the overlap is not tiny.
    EXPECT_LE(width, found + 1e-9) << i;
    if (!std::isfinite(found)) continue;
    ++both;
    if (found - width < 0.5) ++narrow;
  }
  EXPECT_GT(both, 20);
  EXPECT_GE(narrow, both * 95 / 100);
}

TEST(AntipodalPairs, ACubesOppositeSidesAndNothingElse) {
  const TriangleMesh cube = shapes::Cube();
  for (const double mu : {0.0, 0.1, 0.5}) {
    const PairLimits limits = Cone(std::atan(mu));
    const std::vector<FacePair> pairs = AntipodalPairs(cube, limits);
    EXPECT_EQ(pairs, ByAllPairs(cube, limits));
    EXPECT_EQ(pairs.size(), mu > 0.0 ? 12u : pairs.size());
    for (const FacePair& pair : pairs) {
      EXPECT_LT(pair.first, pair.second);
      EXPECT_EQ(AntipodalityAngle(FaceShape(cube, pair.first).normal,
                                  FaceShape(cube, pair.second).normal),
                0.0);
    }
  }
  // From 45 degrees on also sides that meet in an edge: each pair of triangles sees each other.
  EXPECT_GT(CountAntipodalPairs(cube, Cone(45.1 * kDegree)),
            CountAntipodalPairs(cube, Cone(44.9 * kDegree)));
  EXPECT_EQ(CountAntipodalPairs(cube, Cone(44.9 * kDegree)), 12);
  EXPECT_EQ(CountAntipodalPairs(cube, {0.5, 0.99}), 0);
  EXPECT_EQ(CountAntipodalPairs(cube, {0.5, 1.0}), 12);
}

TEST(AntipodalPairs, ARegularTetrahedronHasNoneUntilTheConeReachesHalfOfItsEdgeAngle) {
  const TriangleMesh mesh = shapes::RegularTetrahedron();
  const double half = 0.5 * std::acos(1.0 / 3.0);  // 35.26 degrees, mu = 0.707
  EXPECT_EQ(CountAntipodalPairs(mesh, Cone(std::atan(0.5))), 0);
  EXPECT_EQ(CountAntipodalPairs(mesh, Cone(half - 1e-7)), 0);
  EXPECT_EQ(CountAntipodalPairs(mesh, Cone(half + 1e-7)), 6);
}

TEST(AntipodalPairs, OnASphereAChordHoldsUpToTwiceTheConeFromTheAntipode) {
  const TriangleMesh mesh = shapes::Sphere(1.0, 3);
  const double psi = std::atan(0.5), size = 0.12;  // no face is wider than that, in radians
  const std::vector<FacePair> pairs = AntipodalPairs(mesh, Cone(psi));
  const AntipodalTest test(Cone(psi));
  std::size_t at = 0;
  for (std::int32_t i = 0; i < 1280; ++i) {
    for (std::int32_t j = i + 1; j < 1280; ++j) {
      const FaceShape a(mesh, i), b(mesh, j);
      const double off = AntipodalityAngle(a.center.normalized(), b.center.normalized());
      const bool listed = at < pairs.size() && pairs[at] == FacePair{i, j};
      if (listed) ++at;
      if (std::abs(off - 2 * psi) < 2 * size) continue;
      EXPECT_EQ(listed, off < 2 * psi) << i << " " << j;
    }
  }
  EXPECT_EQ(at, pairs.size());
  EXPECT_EQ(CountAntipodalPairs(mesh, Cone(psi)), static_cast<std::int64_t>(pairs.size()));
}

TEST(AntipodalPairs, TheTreeFindsWhatAllPairsFind) {
  RngStream rng(2, "pairs_tree");
  for (const double psi : {0.05, 0.46, 1.0}) {
    for (const TriangleMesh& mesh :
         {shapes::Shaken(shapes::Torus(1.0, 0.4, 18, 9), 0.02, &rng), shapes::Box({1, 2, 3}),
          shapes::Cylinder(1.0, 2.0, 24), shapes::Dodecahedron()}) {
      for (const double width : {0.7, std::numeric_limits<double>::infinity()}) {
        const PairLimits limits{psi, width};
        const auto pairs = AntipodalPairs(mesh, limits);
        EXPECT_EQ(pairs, ByAllPairs(mesh, limits));
        EXPECT_EQ(CountAntipodalPairs(mesh, limits), static_cast<std::int64_t>(pairs.size()));
      }
    }
  }
}

TEST(AntipodalPairs, OfMoreFacesThanAreCountedTheyAreEstimated) {
  const TriangleMesh mesh = RippledSolid(39);  // 5,928 faces
  const PairLimits limits = Cone(0.46);
  const std::int64_t all = CountAntipodalPairs(mesh, limits, 5928);
  EXPECT_EQ(all, std::ssize(AntipodalPairs(mesh, limits)));
  const std::int64_t estimate = CountAntipodalPairs(mesh, limits, 4000);
  EXPECT_NE(estimate, all);
  EXPECT_NEAR(static_cast<double>(estimate) / static_cast<double>(all), 1.0, 0.01);
  EXPECT_EQ(CountAntipodalPairs(mesh, limits, 4000), estimate);
  const std::int64_t coarse = CountAntipodalPairs(mesh, limits, 400);
  EXPECT_NEAR(static_cast<double>(coarse) / static_cast<double>(all), 1.0, 0.06);
}

TEST(AntipodalPairs, DoNotDependOnWhereTheObjectIsOrHowLarge) {
  RngStream rng(3, "pairs_motion");
  const TriangleMesh mesh = shapes::Shaken(shapes::Sphere(1.0, 2), 0.05, &rng);
  const auto pairs = AntipodalPairs(mesh, {0.4, 1.7});
  EXPECT_GT(pairs.size(), 100u);
  for (int i = 0; i < 5; ++i) {
    const double scale = std::pow(10.0, rng.Uniform(-3.0, 3.0));
    const TriangleMesh moved =
        Transformed(shapes::Rotated(mesh, shapes::RandomRotation(&rng)), scale, {5, -3, 2});
    EXPECT_EQ(AntipodalPairs(moved, {0.4, 1.7 * scale}), pairs);
  }
}

TEST(AntipodalPairs, FacesWithoutAreaAndEmptyMeshesHaveNone) {
  EXPECT_EQ(CountAntipodalPairs({}, {}), 0);
  TriangleMesh mesh = shapes::Cube();
  mesh.faces.push_back({0, 0, 1});
  mesh.faces.push_back({2, 2, 2});
  EXPECT_EQ(CountAntipodalPairs(mesh, {}), 12);
  const TriangleMesh flat =
      shapes::Triangles({{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(2, 0, 0)}});
  EXPECT_EQ(CountAntipodalPairs(flat, {}), 0);
}

TEST(AntipodalPairs, JawsThatOpenToTheWidthOfACubeHoldItsSides) {
  // Both triangles of a side have both of the side across: four pairs along each axis.
  for (const double offset : {0.0, 125.3, 1253.7}) {
    TriangleMesh cube =
        Transformed(shapes::Box(Vector3d::Constant(40.0)), 1.0, {offset, -offset, 0.1 + offset});
    cube = InSinglePrecision(cube);
    EXPECT_EQ(AntipodalPairs(cube, {0.1, 40.0, 1e-5}).size(), 12u) << offset;
    EXPECT_EQ(CountAntipodalPairs(cube, {0.1, 40.0, 1e-5}), 12) << offset;
    EXPECT_EQ(AntipodalPairs(cube, {0.1, 39.99, 1e-5}).size(), 0u) << offset;
  }
}

}  // namespace
}  // namespace antigrasp
