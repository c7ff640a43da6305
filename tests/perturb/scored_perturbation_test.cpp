#include "antigrasp/perturb/scored_perturbation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/perturb/random_perturbation.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

PerturbSettings Quick(int iterations) {
  PerturbSettings settings;
  settings.metric.num_grasps = 10;
  settings.metric.num_draws = 3;
  settings.method = [iterations](const TriangleMesh& mesh, const PairLimits& pairs,
                                 const PerturbOptions& common, RngStream* rng,
                                 const ProgressFn& progress) {
    RandomPerturbOptions options;
    options.iterations = iterations;
    options.alpha = iterations > 1 ? 15.0 : 0.0;
    return PerturbRandomly(mesh, pairs, common, options, rng, progress);
  };
  return settings;
}

TEST(PerturbAndScore, AnUnchangedObjectScoresTheSame) {
  const ScoredPerturbation s = PerturbAndScore(shapes::Sphere(1.0, 2), Quick(1), 7);
  EXPECT_EQ(s.result.moved, 0);
  EXPECT_EQ(s.graspability_after, s.graspability_before);
  EXPECT_EQ(s.pairs_after, s.pairs_before);
  EXPECT_EQ(s.normals.largest, 0.0);
  EXPECT_NEAR(s.similarity.hausdorff, 0.0, 1e-12);
  EXPECT_EQ(s.similarity.volume_change, 0.0);
}

TEST(PerturbAndScore, ReportsAChangedObjectAndDependsOnItsNumber) {
  const TriangleMesh mesh = shapes::Cylinder(1.0, 3.0, 32);
  const ScoredPerturbation a = PerturbAndScore(mesh, Quick(500), 3);
  const ScoredPerturbation b = PerturbAndScore(mesh, Quick(500), 3);
  const ScoredPerturbation c = PerturbAndScore(mesh, Quick(500), 4);
  EXPECT_EQ(a.result.mesh.vertices, b.result.mesh.vertices);
  EXPECT_EQ(a.graspability_after, b.graspability_after);
  EXPECT_NE(a.result.mesh.vertices, c.result.mesh.vertices);
  EXPECT_NE(a.graspability_before, c.graspability_before);
  EXPECT_LT(a.pairs_after, a.pairs_before);
  EXPECT_LE(a.normals.largest, 15.0);
  EXPECT_LE(a.normals.mean, a.normals.largest);
  EXPECT_GT(a.similarity.hausdorff, a.similarity.chamfer);
  EXPECT_GT(a.seconds, 0.0);
}

TEST(PerturbAndScore, GivesNoNumbersForWhatIsNoSolid) {
  TriangleMesh not_finite = shapes::Cube();
  not_finite.vertices[0].x() = std::nan("");
  for (const TriangleMesh& mesh : {TriangleMesh{}, shapes::FlatSquare(), not_finite}) {
    const ScoredPerturbation s = PerturbAndScore(mesh, Quick(10), 0);
    EXPECT_TRUE(s.result.failure.starts_with("before: "));
    EXPECT_TRUE(std::isnan(s.graspability_before));
    EXPECT_TRUE(std::isnan(s.similarity.hausdorff));
    EXPECT_EQ(s.pairs_before, -1);
  }
}

TEST(KappaReduction, IsTheFallOfTheMeanWithAPairedInterval) {
  // Every object falls by a tenth: no doubt about the ratio.
  const MeanInterval exact = KappaReduction({1, 2, 3, 10}, {0.9, 1.8, 2.7, 9.0});
  EXPECT_NEAR(exact.mean, 10.0, 1e-12);
  EXPECT_NEAR(exact.half_width, 0.0, 1e-9);
  EXPECT_EQ(exact.count, 4);
  // Residuals +-0.1 about a ratio of 1, both means 1: standard error 0.1 / sqrt 3.
  const MeanInterval mixed = KappaReduction({1, 1, 1, 1}, {1.1, 0.9, 1.1, 0.9});
  EXPECT_NEAR(mixed.mean, 0.0, 1e-12);
  EXPECT_NEAR(mixed.half_width, 1.96 * 10.0 / std::sqrt(3.0), 0.01);
  const double nan = std::nan("");
  EXPECT_EQ(KappaReduction({1, nan, 1}, {1, 1, nan}).count, 1);
}

}  // namespace
}  // namespace antigrasp
