#include "antigrasp/perturb/random_perturbation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/perturb/mesh_change.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

PerturbResult Perturbed(const TriangleMesh& mesh, const RandomPerturbOptions& options,
                        const PerturbOptions& common = {}, std::uint64_t seed = 1) {
  RngStream rng(seed, "perturb");
  return PerturbRandomly(mesh, PairLimitsOf(common, 0.5, 1.0), common, options, &rng);
}

TEST(AllowedSteps, EndWhereASideHasTurnedByTheAngle) {
  const EditableMesh mesh(shapes::Box({1, 1, 1}));
  // A corner that moves outwards along z tilts the top's triangles; each has its other corners at
  // distance 1 (a leg of the square) or 1 / sqrt 2 (its diagonal).
  for (std::int32_t v = 0; v < 8; ++v) {
    const Vector3d up(0, 0, mesh.Position(v).z() > 0 ? 1 : -1);
    double nearest = 1e9;
    for (const std::int32_t f : mesh.FacesOf(v)) {
      if (std::abs(mesh.Normal(f).z()) < 0.5) continue;
      const auto& face = mesh.mesh().faces[f];
      std::vector<Vector3d> others;
      for (const std::int32_t w : face) {
        if (w != v) others.push_back(mesh.Position(w));
      }
      const Vector3d along = (others[1] - others[0]).normalized();
      const Vector3d to = mesh.Position(v) - others[0];
      nearest = std::min(nearest, (to - to.dot(along) * along).norm());
    }
    const Range range = AllowedSteps(mesh, v, up, 10 * kDegree, true, {0.0, 100.0});
    EXPECT_EQ(range.low, 0.0);
    EXPECT_NEAR(range.high, nearest * std::tan(10 * kDegree), 1e-9);
    // The other way it is the same.
    EXPECT_NEAR(AllowedSteps(mesh, v, -up, 10 * kDegree, false, {0.0, 100.0}).high, range.high,
                1e-9);
  }
}

TEST(BestStep, IsBetterThanEveryOtherStepInTheRange) {
  RngStream rng(5, "best_step");
  const EditableMesh mesh(shapes::Shaken(shapes::Torus(1.0, 0.4, 12, 8), 0.02, &rng));
  for (int i = 0; i < 500; ++i) {
    const auto first = static_cast<std::int32_t>(rng.Below(192));
    const auto second = static_cast<std::int32_t>(rng.Below(192));
    if (first == second) continue;
    const std::int32_t vertex = mesh.mesh().faces[first][rng.Below(3)];
    const Vector3d direction = Vector3d(rng.Normal(), rng.Normal(), rng.Normal()).normalized();
    const Range within{0.0, rng.Uniform(0.01, 0.5)};
    const Step best = BestStep(mesh, first, second, vertex, direction, within);
    ASSERT_GE(best.length, within.low);
    ASSERT_LE(best.length, within.high);
    // Two faces that both hold the vertex are searched in steps, else the answer is exact.
    const auto& other = mesh.mesh().faces[second];
    const bool in_both = std::find(other.begin(), other.end(), vertex) != other.end();
    for (int k = 0; k <= 20; ++k) {
      TriangleMesh moved = mesh.mesh();
      moved.vertices[vertex] += within.high * k / 20 * direction;
      const double angle =
          AntipodalityAngle(FaceShape(moved, first).normal, FaceShape(moved, second).normal);
      EXPECT_GE(best.angle, angle - (in_both ? 1e-2 : 1e-9)) << i;
    }
    TriangleMesh moved = mesh.mesh();
    moved.vertices[vertex] += best.length * direction;
    EXPECT_NEAR(best.angle,
                AntipodalityAngle(FaceShape(moved, first).normal, FaceShape(moved, second).normal),
                1e-9);
  }
}

TEST(PerturbRandomly, KeepsEveryNormalWithinAlphaAndLowersTheNumberOfPairs) {
  const TriangleMesh mesh = shapes::Cylinder(1.0, 3.0, 48);
  for (const double alpha : {10.0, 20.0}) {
    for (const Choice<StepRule>& step : ChoicesOf(StepRule())) {
      RandomPerturbOptions options;
      options.alpha = alpha;
      options.step = step.value;
      const PerturbResult result = Perturbed(mesh, options);
      EXPECT_EQ(result.failure, "");
      EXPECT_GT(result.moved, 20);
      const double turned = CompareNormals(result.start, result.mesh).largest;
      EXPECT_LE(turned, alpha + 1e-9) << step.name;
      EXPECT_GT(turned, 0.9 * alpha) << step.name;
      EXPECT_EQ(WhyNotSolid(Inspect(result.mesh)), "");
    }
  }
}

TEST(PerturbRandomly, TheLimitOfAStepLetsNormalsDriftAndTheGuardKeepsASolid) {
  RandomPerturbOptions options;
  options.limit = NormalLimit::kStep;
  options.iterations = 800;
  const TriangleMesh mesh = shapes::Sphere(1.0, 2);
  const PerturbResult guarded = Perturbed(mesh, options);
  EXPECT_EQ(guarded.failure, "");
  EXPECT_GT(CompareNormals(guarded.start, guarded.mesh).largest, 30.0);
  PerturbOptions unguarded;
  unguarded.unchecked = true;
  options.iterations = 8000;
  options.step = StepRule::kLargest;
  EXPECT_NE(Perturbed(mesh, options, unguarded).failure, "");  // the literal algorithm breaks it
  const PerturbResult longer = Perturbed(mesh, options);
  EXPECT_EQ(longer.failure, "");
  EXPECT_GT(longer.refused[static_cast<std::size_t>(MoveVerdict::kIntersects)], 0);
}

TEST(PerturbRandomly, GivesTheSameMeshForTheSameStreamAndAnotherForAnother) {
  const TriangleMesh mesh = shapes::Sphere(1.0, 2);
  const PerturbResult a = Perturbed(mesh, {}), b = Perturbed(mesh, {}),
                      c = Perturbed(mesh, {}, {}, 2);
  EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
  EXPECT_NE(a.mesh.vertices, c.mesh.vertices);
  EXPECT_EQ(a.start.faces, a.mesh.faces);
}

TEST(PerturbRandomly, CountsPairsOnTheWayAndReportsItsIterations) {
  PerturbOptions common;
  common.history = true;
  RandomPerturbOptions options;
  options.iterations = 400;
  std::vector<std::int64_t> reported;
  RngStream rng(1, "perturb");
  const PerturbResult result = PerturbRandomly(shapes::Box({1, 2, 3}), {}, common, options, &rng,
                                               [&](std::int64_t done, std::int64_t total) {
                                                 EXPECT_EQ(total, 400);
                                                 reported.push_back(done);
                                               });
  EXPECT_EQ(result.iterations, 400);
  ASSERT_EQ(result.history.size(), kHistoryCounts + 1u);
  EXPECT_EQ(result.history.front().iteration, 0);
  EXPECT_EQ(result.history.front().pairs, CountAntipodalPairs(result.start, {}));
  EXPECT_EQ(result.history.back().iteration, 400);
  EXPECT_EQ(result.history.back().pairs, CountAntipodalPairs(result.mesh, {}));
  EXPECT_EQ(reported.size(), 400u);
  EXPECT_EQ(reported.back(), 400);
}

TEST(PerturbRandomly, EndsWhenThereIsNoPair) {
  const PerturbResult result = Perturbed(shapes::RegularTetrahedron(), {});
  EXPECT_TRUE(result.no_pairs_left);
  EXPECT_EQ(result.moved, 0);
  EXPECT_EQ(result.failure, "");
  EXPECT_EQ(result.mesh.vertices, result.start.vertices);
}

TEST(PerturbRandomly, RefusesWhatIsNoSolidWithTheReason) {
  const TriangleMesh cube = shapes::Cube();
  TriangleMesh not_finite = cube;
  not_finite.vertices[0].x() = std::nan("");
  TriangleMesh out_of_range = cube;
  out_of_range.faces[0][0] = 99;
  TriangleMesh too_fine = Transformed(shapes::Sphere(1e-7, 2), 1.0, {1, 1, 1});
  for (const TriangleMesh& mesh :
       {TriangleMesh{}, shapes::FlatSquare(), shapes::Inverted(cube), not_finite, out_of_range,
        shapes::Joined(cube, Transformed(cube, 1.0, {5, 0, 0})),
        shapes::Joined(cube, Transformed(cube, 1.0, {0.5, 0.5, 0.5})), too_fine}) {
    const PerturbResult result = Perturbed(mesh, {});
    EXPECT_TRUE(result.failure.starts_with("before: ")) << result.failure;
    EXPECT_TRUE(result.mesh.faces.empty());
  }
}

TEST(PerturbRandomly, AWidthLimitLeavesWiderPairsAlone) {
  PerturbOptions common;
  common.max_width = 1.5;
  RandomPerturbOptions options;
  options.iterations = 500;
  const TriangleMesh box = shapes::Box({1, 2, 3});
  EXPECT_GT(Perturbed(box, options, common).moved, 0);
  common.max_width = 0.5;
  EXPECT_TRUE(Perturbed(box, options, common).no_pairs_left);
}

}  // namespace
}  // namespace antigrasp
