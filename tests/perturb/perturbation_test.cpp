#include "antigrasp/perturb/perturbation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/angles.h"
#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/draw_direction.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/mesh_change.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

// What the three algorithms share: their limits, their clock, and one move of each by hand.
namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(PairLimits, AreTheConeInRadiansAndTheWidthInTheMeshsUnit) {
  PerturbOptions options;
  const PairLimits by_friction = PairLimitsOf(options, 0.7, 0.05);
  EXPECT_EQ(by_friction.cone_angle, std::atan(0.7));
  EXPECT_EQ(by_friction.max_width, std::numeric_limits<double>::infinity());
  options.cone = 30.0;
  options.max_width = 0.1;
  const PairLimits by_hand = PairLimitsOf(options, 0.7, 0.05);
  EXPECT_NEAR(by_hand.cone_angle, std::numbers::pi / 6.0, 1e-15);
  EXPECT_EQ(by_hand.width_slack, 1e-5);
  EXPECT_NEAR(by_hand.max_width, 2.0, 1e-12);  // 0.1 m of a mesh whose unit is 0.05 m
  EXPECT_NEAR(PairLimits().cone_angle, std::atan(0.5), 1e-15);
}

TEST(GuardLimits, AreTheDefaultsAndUncheckedNone) {
  PerturbOptions options;
  const MoveLimits guarded = GuardLimits(options);
  EXPECT_NEAR(guarded.max_turn_from_start, std::numbers::pi, 1e-15);
  EXPECT_NEAR(guarded.max_turn_per_move, 0.5 * std::numbers::pi, 1e-15);
  EXPECT_EQ(guarded.min_height, 1e-3);
  EXPECT_TRUE(guarded.check_intersections);
  options.unchecked = true;
  const MoveLimits unchecked = GuardLimits(options);
  EXPECT_NEAR(unchecked.max_turn_from_start, std::numbers::pi, 1e-15);
  EXPECT_NEAR(unchecked.max_turn_per_move, std::numbers::pi, 1e-15);
  EXPECT_EQ(unchecked.min_height, 0.0);
  EXPECT_FALSE(unchecked.check_intersections);
}

TEST(PerturbClock, CountsPairsTwentyTimesAtEvenIntervals) {
  const EditableMesh mesh(shapes::Cube());
  const PairLimits limits{0.3};
  const auto marks = [&](std::int64_t iterations) {
    PerturbResult result;
    const PerturbClock clock(iterations, true, limits, nullptr);
    for (std::int64_t i = 0; i <= iterations; ++i) clock.Tick(mesh, i, &result);
    std::vector<std::int64_t> at;
    for (const PairCount& count : result.history) {
      EXPECT_EQ(count.pairs, 12);
      EXPECT_EQ(count.below, -1);
      at.push_back(count.iteration);
    }
    return at;
  };
  std::vector<std::int64_t> every_fifth;
  for (int i = 0; i <= 100; i += 5) every_fifth.push_back(i);
  EXPECT_EQ(marks(100), every_fifth);
  EXPECT_EQ(marks(3), (std::vector<std::int64_t>{0, 1, 2, 3}));  // fewer than twenty: all
  PerturbResult none;
  PerturbClock(3, false, limits, nullptr).Tick(mesh, 3, &none);
  EXPECT_TRUE(none.history.empty());
}

TEST(DrawDirection, IsUniformOverTheSphere) {
  RngStream rng(1, "directions");
  constexpr int kDraws = 20000;
  Vector3d mean = Vector3d::Zero(), squares = Vector3d::Zero(), fourth = Vector3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Vector3d d = DrawDirection(&rng);
    ASSERT_NEAR(d.norm(), 1.0, 1e-12);
    const Eigen::Array3d square = d.array().square();
    mean += d / kDraws;
    squares += square.matrix() / kDraws;
    fourth += square.square().matrix() / kDraws;
  }
  // Each coordinate is uniform in [-1, 1]: moments 0, 1/3, 1/5; 5 standard errors are 0.02.
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(mean[k], 0.0, 0.021);
    EXPECT_NEAR(squares[k], 1.0 / 3.0, 0.011);
    EXPECT_NEAR(fourth[k], 0.2, 0.01);
  }
}

PerturbResult Rotated(const TriangleMesh& mesh, const RotationOptions& options,
                      const PerturbOptions& common = {}) {
  RngStream rng(1, "perturb");
  return PerturbByRotation(mesh, PairLimitsOf(common, 0.5, 1.0), common, options, &rng);
}

TEST(PerturbByRotation, TurnsBothFacesByBetaOfTheMissingAngle) {
  // A slab whose top is tilted by phi; its sides are further apart than asked for, and no face of
  // the top has a corner in common with one of the bottom: theta = beta (psi - phi).
  for (const auto& [beta, phi] : {std::pair{0.1, 0.0}, {0.3, 0.0}, {0.1, 8.0}, {0.5, 8.0}}) {
    TriangleMesh slab = shapes::Box({1.0, 1.0, 0.3});
    for (Vector3d& v : slab.vertices) {
      if (v.x() > 0 && v.z() > 0) v.z() += std::tan(phi * kDegree);
    }
    PerturbOptions common;
    common.cone = 20.0;
    common.max_width = 0.6;
    RotationOptions options;
    options.beta = beta;
    options.iterations = 1;
    const PerturbResult result = Rotated(slab, options, common);
    ASSERT_EQ(result.moved, 1);
    const double theta = beta * (20.0 - phi) * kDegree;
    const auto turned = [&](std::int32_t f) {
      const FaceShape from(result.start, f), to(result.mesh, f);
      return std::abs(AntipodalityAngle(from.normal, -to.normal) - theta) < 1e-6 &&
             (from.center - to.center).norm() < 1e-6;
    };
    int found = 0;
    for (const FacePair& pair : AntipodalPairs(result.start, {20.0 * kDegree, 0.6})) {
      if (!turned(pair.first) || !turned(pair.second)) continue;
      const FaceShape a(result.mesh, pair.first), b(result.mesh, pair.second);
      EXPECT_NEAR(AntipodalityAngle(a.normal, b.normal), phi * kDegree + 2.0 * theta, 1e-6);
      ++found;
    }
    EXPECT_EQ(found, 1) << beta << " " << phi;
  }
}

TEST(PerturbByRotation, CountsItsIterationsByTheFacesThatAreLeft) {
  RotationOptions options;
  options.iterations_per_face = 2.5;
  EXPECT_EQ(Rotated(shapes::Cube(), options).iterations, 30);
  options.max_faces = 100;
  const PerturbResult ball = Rotated(shapes::Sphere(1.0, 2), options);  // 320 faces
  ASSERT_LT(ball.start.faces.size(), 100u);
  EXPECT_EQ(ball.iterations, std::llround(2.5 * static_cast<double>(ball.start.faces.size())));
  std::int64_t sum = ball.moved + ball.no_gain;
  for (const std::int64_t refused : ball.refused) sum += refused;
  EXPECT_EQ(sum, ball.iterations);
  EXPECT_EQ(ball.refused[static_cast<std::size_t>(MoveVerdict::kOk)], 0);
  options.iterations = 7;
  EXPECT_EQ(Rotated(shapes::Cube(), options).iterations, 7);
}

TEST(PerturbByRotation, TheGuardsAngleIsInDegrees) {
  // theta = 0.3 x 26.6 = 8 degrees.
  RotationOptions options;
  options.beta = 0.3;
  options.max_turn = 7.9;
  const PerturbResult tight = Rotated(shapes::Cube(), options);
  EXPECT_EQ(tight.moved, 0);
  EXPECT_EQ(tight.refused[static_cast<std::size_t>(MoveVerdict::kTurned)], tight.iterations);
  options.max_turn = 40.0;
  const PerturbResult wide = Rotated(shapes::Cube(), options);
  EXPECT_GT(wide.moved, 0);
  EXPECT_GT(CompareNormals(wide.start, wide.mesh).largest, 7.9);
}

TEST(PerturbExhaustively, KnowsPairsInTheConeFromPairsBelowIt) {
  // The sides of a wedge of 16 degrees are a pair for psi > 8 degrees, and no longer below psi when
  // it is under 16. The ends, which are parallel, are further apart than asked for.
  const double t = std::tan(8 * kDegree);
  const TriangleMesh wedge{
      {{0, -1, 0}, {0, 1, 0}, {1, -1, t}, {1, 1, t}, {1, -1, -t}, {1, 1, -t}},
      {{0, 3, 1}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}}};
  PerturbOptions common;
  common.history = true;
  common.max_width = 0.5;
  for (const auto& [cone, all_below] : {std::pair{10.0, false}, std::pair{17.0, true}}) {
    common.cone = cone;
    RngStream rng(1, "perturb");
    ExhaustiveOptions options;
    options.iterations = 1;
    const PerturbResult result =
        PerturbExhaustively(wedge, PairLimitsOf(common, 0.5, 1.0), common, options, &rng);
    const PairCount& first = result.history.front();
    EXPECT_GE(first.pairs, 2);
    EXPECT_EQ(first.below, all_below ? first.pairs : 0) << cone;
    EXPECT_EQ(result.iterations, all_below ? 1 : 0);
    EXPECT_EQ(result.no_pairs_left, !all_below);
    EXPECT_EQ(result.moved + result.no_gain, result.iterations);
  }
}

TEST(PerturbExhaustively, TakesTheDirectionThatRaisesTheAnglesMost) {
  // Of more directions the best is better: the sum of all angles of F_a after one iteration.
  const TriangleMesh cube = shapes::Cube();
  const PairLimits limits{0.4};
  const auto sum_of_angles = [&](int directions) {
    double sum = 0.0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      RngStream rng(seed, "perturb");
      ExhaustiveOptions options;
      options.iterations = 1;
      options.step = 1.0;
      options.directions = directions;
      const PerturbResult result = PerturbExhaustively(cube, limits, {}, options, &rng);
      for (const FacePair& pair : AntipodalPairs(cube, limits)) {
        sum += AntipodalityAngle(FaceShape(result.mesh, pair.first).normal,
                                 FaceShape(result.mesh, pair.second).normal);
      }
    }
    return sum;
  };
  EXPECT_GT(sum_of_angles(30), 1.2 * sum_of_angles(1));
}

}  // namespace
}  // namespace antigrasp
