#include "antigrasp/perturb/exhaustive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/perturb/draw_direction.h"
#include "antigrasp/perturb/face_pairs.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

PerturbResult Perturbed(const TriangleMesh& mesh, const PerturbOptions& common,
                        const ExhaustiveOptions& options, std::uint64_t seed = 1) {
  RngStream rng(seed, "perturb");
  return PerturbExhaustively(mesh, PairLimitsOf(common, 0.5, 1.0), common, options, &rng);
}

PerturbOptions Figure1() {
  PerturbOptions common;
  common.cone = 10.0;
  common.history = true;
  return common;
}

TEST(PerturbExhaustively, ADodecahedronLosesItsAntipodalPairsAsInFigure1) {
  const TriangleMesh mesh = shapes::Dodecahedron();
  ASSERT_NEAR(Volume(mesh), 2.785163863, 1e-6);  // circumradius 1, paper arithmetic
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const PerturbResult result = Perturbed(mesh, Figure1(), {}, seed);
    EXPECT_EQ(result.failure, "");
    ASSERT_EQ(result.history.size(), static_cast<std::size_t>(result.iterations) + 1);
    const std::int64_t before = result.history.front().pairs;
    EXPECT_EQ(before, CountAntipodalPairs(result.start, {10 * kDegree}));
    EXPECT_EQ(result.history.front().below, before);  // opposite pentagons are parallel
    // It falls, from about the twentieth iteration on, to a fifth.
    EXPECT_EQ(before, 51);
    EXPECT_GT(result.history[10].pairs, 45) << seed;
    EXPECT_LT(result.history[40].pairs, 40) << seed;
    EXPECT_LT(result.history.back().pairs, 18) << seed;
  }
}

TEST(PerturbExhaustively, EndsWhenNoPairIsBelowTheCone) {
  PerturbOptions common = Figure1();
  common.cone = 3.0;
  ExhaustiveOptions options;
  options.iterations = 500;
  const PerturbResult result = Perturbed(shapes::Cube(), common, options);
  EXPECT_EQ(result.failure, "");
  EXPECT_TRUE(result.no_pairs_left);
  EXPECT_LT(result.iterations, 500);
  EXPECT_EQ(result.history.back().below, 0);
  const PerturbResult none = Perturbed(shapes::RegularTetrahedron(), Figure1(), options);
  EXPECT_EQ(none.iterations, 0);
  EXPECT_EQ(none.mesh.vertices, none.start.vertices);
}

TEST(PerturbExhaustively, TakesNoPlaceThatIsWorseWhenAsked) {
  ExhaustiveOptions options;
  options.only_if_better = true;
  options.iterations = 20;
  PerturbOptions common = Figure1();
  const PerturbResult result = Perturbed(shapes::Sphere(1.0, 1), common, options);
  EXPECT_EQ(result.failure, "");
  EXPECT_LT(result.history.back().pairs, result.history.front().pairs);
}

TEST(PerturbExhaustively, StepsHaveTheirLengthAndTheStreamDecides) {
  ExhaustiveOptions options;
  options.iterations = 1;
  options.step = 2.0;
  const TriangleMesh box = shapes::Box({1, 2, 2});
  const PerturbResult a = Perturbed(box, {}, options), b = Perturbed(box, {}, options);
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_NEAR((a.mesh.vertices[v] - a.start.vertices[v]).norm(), 0.02 * 3.0, 1e-6);
  }
  EXPECT_NE(Perturbed(box, {}, options, 2).mesh.vertices, a.mesh.vertices);
  std::int64_t reported = 0;
  options.iterations = 3;
  RngStream rng(1, "perturb");
  PerturbExhaustively(box, {}, {}, options, &rng, [&](std::int64_t done, std::int64_t total) {
    EXPECT_EQ(total, 3);
    EXPECT_EQ(done, ++reported);
  });
  EXPECT_EQ(reported, 3);
}

TEST(PerturbExhaustively, MovesAVertexToWhereTheSumOverItsPairsIsLargestEachCountedOnce) {
  // A lens with a square rim. Vertex 0 is on it: faces above and below that meet there are a pair.
  const TriangleMesh lens{
      {{1, 0, 0}, {0, 1.25, 0}, {-1.5, 0, 0}, {0, -0.75, 0}, {0.125, 0, 0.25}, {0, 0.125, -0.25}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
  const auto holds = [&](std::int32_t face) {
    const auto& corners = lens.faces[static_cast<std::size_t>(face)];
    return std::find(corners.begin(), corners.end(), 0) != corners.end();
  };
  std::vector<FacePair> of_vertex;
  int both = 0;
  for (const FacePair& pair : AntipodalPairs(lens, PairLimitsOf({}, 0.5, 1.0))) {
    if (holds(pair.first) || holds(pair.second)) of_vertex.push_back(pair);
    both += holds(pair.first) && holds(pair.second) ? 1 : 0;
  }
  ASSERT_GT(both, 0);
  ASSERT_GT(std::ssize(of_vertex), both);
  ExhaustiveOptions options;
  options.iterations = 1;
  options.directions = 1000;  // the more, the finer the sums are told apart
  RngStream rng(1, "perturb");
  TriangleMesh moved = lens;
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double largest = -1.0;
  for (int i = 0; i < options.directions; ++i) {
    moved.vertices[0] =
        lens.vertices[0] + 0.001 * Bounds(lens).Extent().norm() * DrawDirection(&rng);
    double sum = 0.0;
    for (const FacePair& pair : of_vertex) {
      sum += AntipodalityAngle(FaceShape(moved, static_cast<std::size_t>(pair.first)).normal,
                               FaceShape(moved, static_cast<std::size_t>(pair.second)).normal);
    }
    if (sum > largest) best = moved.vertices[0];
    largest = std::max(largest, sum);
  }
  PerturbOptions common;
  common.unchecked = true;
  EXPECT_LT((Perturbed(lens, common, options).mesh.vertices[0] - best).norm(), 1e-6);
}

TEST(PerturbExhaustively, RefusesWhatIsNoSolid) {
  EXPECT_TRUE(Perturbed(shapes::FlatSquare(), {}, {}).failure.starts_with("before: open"));
  EXPECT_TRUE(Perturbed({}, {}, {}).failure.starts_with("before: empty"));
}

}  // namespace
}  // namespace antigrasp
