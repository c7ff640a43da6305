#include "antigrasp/quality/adaptive_draws.h"

#include <gtest/gtest.h>

#include <set>

#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/parallel_jaws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

std::vector<TriangleMesh> Objects() {
  return {shapes::Sphere(0.02, 3), shapes::Cylinder(0.02, 0.08, 24),
          shapes::Box({0.04, 0.05, 0.09}), shapes::Torus(0.035, 0.02, 24, 12)};
}

TEST(AdaptiveDraws, GiveTheAnswerOfFullSamplingWithinItsInterval) {
  for (const TriangleMesh& mesh : Objects()) {
    MetricOptions full, adaptive;
    adaptive.adaptive = true;
    for (std::uint64_t object = 0; object < 5; ++object) {
      const Graspability a = EvaluateGraspability(mesh, full, 1, object);
      const Graspability b = EvaluateGraspability(mesh, adaptive, 1, object);
      EXPECT_GE(b.value, a.ci_low);
      EXPECT_LE(b.value, a.ci_high);
    }
  }
}

TEST(AdaptiveDraws, SpendFewerDrawsAndNoneBeyondTheLimit) {
  MetricOptions options;
  options.adaptive = true;
  options.num_draws = 100;
  for (const TriangleMesh& mesh : Objects()) {
    const Graspability score = EvaluateGraspability(mesh, options, 1, 0);
    int draws = 0;
    for (const ScoredGrasp& scored : score.grasps) {
      EXPECT_GE(scored.draws, 20);
      EXPECT_LE(scored.draws, 100);
      draws += scored.draws;
    }
    EXPECT_LT(draws, 90 * static_cast<int>(score.grasps.size()));
  }
}

// Five draws done, of this mean and this variance (of a sample: over n - 1).
NoisyGrasp Drawn(double mean, double variance) {
  NoisyGrasp noisy{{}, RngStream(1, "noise")};
  noisy.draws = 5;
  noisy.sum = 5.0 * mean;
  noisy.sum_of_squares = 4.0 * variance + 5.0 * mean * mean;
  return noisy;
}

// The draws that the last grasp has after one round. Twenty others of mean 1 make [1, 1] the
// interval of the median.
int DrawsAfterOneRound(const NoisyGrasp& last, double variance_of_others) {
  const TriangleMesh cube = shapes::Cube();
  const RayScene scene(cube);
  MetricOptions options;
  options.percentile = 50.0;
  options.num_draws = 10;
  std::vector<NoisyGrasp> grasps(20, Drawn(1.0, variance_of_others));
  grasps.push_back(last);
  DrawAdaptively(*ParallelJaws({cube, scene, Eigen::Vector3d::Zero()}, options), options, &grasps);
  EXPECT_EQ(grasps[0].draws, 10);
  return grasps.back().draws;
}

TEST(AdaptiveDraws, AGraspIsDecidedTwoAndAHalfStandardErrorsFromTheInterval) {
  // Variance 0.2 of five draws: standard error 0.2, half width 0.5.
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(DrawsAfterOneRound(Drawn(1.0 + 0.499 * side, 0.2), 0.0), 10) << side;
    EXPECT_EQ(DrawsAfterOneRound(Drawn(1.0 + 0.501 * side, 0.2), 0.0), 5) << side;
  }
}

TEST(AdaptiveDraws, AgreementOfAFewDrawsCountsAsHalfTheUsualSpreadAtLeast) {
  // Variance 0 where the mean over all 21 is 20/21 x 0.84 = 0.8: taken as a quarter, 0.2.
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(DrawsAfterOneRound(Drawn(1.0 + 0.499 * side, 0.0), 0.84), 10) << side;
    EXPECT_EQ(DrawsAfterOneRound(Drawn(1.0 + 0.501 * side, 0.0), 0.84), 5) << side;
  }
}

TEST(AdaptiveDraws, BeginWithAFifthButFiveAtLeastAndDouble) {
  const auto counts = [](int most) {
    MetricOptions options;
    options.adaptive = true;
    options.num_draws = most;
    std::set<int> draws;
    for (const ScoredGrasp& scored :
         EvaluateGraspability(shapes::Torus(0.035, 0.02, 24, 12), options, 1, 0).grasps) {
      draws.insert(scored.draws);
    }
    return draws;
  };
  EXPECT_EQ(counts(3), (std::set{3}));
  EXPECT_EQ(counts(5), (std::set{5}));
  EXPECT_EQ(counts(12), (std::set{5, 10, 12}));
  EXPECT_EQ(counts(70), (std::set{14, 28, 56, 70}));
}

TEST(AdaptiveDraws, AGraspThatStaysInHasItsFullQuality) {
  const TriangleMesh mesh = shapes::Torus(0.035, 0.02, 24, 12);
  MetricOptions options;
  const Graspability full = EvaluateGraspability(mesh, options, 1, 0);
  options.adaptive = true;
  const Graspability adaptive = EvaluateGraspability(mesh, options, 1, 0);
  ASSERT_EQ(full.grasps.size(), adaptive.grasps.size());
  int stayed = 0;
  for (std::size_t g = 0; g < full.grasps.size(); ++g) {
    if (adaptive.grasps[g].draws < options.num_draws) continue;
    EXPECT_EQ(adaptive.grasps[g].quality, full.grasps[g].quality);
    ++stayed;
  }
  EXPECT_GT(stayed, 5);
}

TEST(AdaptiveDraws, WithoutNoiseTheFirstDrawsDecideEverything) {
  MetricOptions options;
  ApplyNoisePreset("none", &options);
  const Graspability full = EvaluateGraspability(shapes::Sphere(0.02, 3), options, 1, 0);
  options.adaptive = true;
  EXPECT_EQ(EvaluateGraspability(shapes::Sphere(0.02, 3), options, 1, 0).value, full.value);
}

}  // namespace
}  // namespace antigrasp
