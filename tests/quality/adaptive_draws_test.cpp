#include "antigrasp/quality/adaptive_draws.h"

#include <gtest/gtest.h>

#include "antigrasp/quality/graspability.h"
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
