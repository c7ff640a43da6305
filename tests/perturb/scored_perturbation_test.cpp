#include "antigrasp/perturb/scored_perturbation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "antigrasp/perturb/search.h"
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
  EXPECT_NEAR(s.change.hausdorff, 0.0, 1e-12);
  EXPECT_EQ(s.change.volume_change, 0.0);
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
  EXPECT_GT(a.change.hausdorff, a.change.chamfer);
  EXPECT_GT(a.seconds, 0.0);
}

TEST(PerturbAndScore, GivesNoNumbersForWhatIsNoSolid) {
  TriangleMesh not_finite = shapes::Cube();
  not_finite.vertices[0].x() = std::nan("");
  for (const TriangleMesh& mesh : {TriangleMesh{}, shapes::FlatSquare(), not_finite}) {
    const ScoredPerturbation s = PerturbAndScore(mesh, Quick(10), 0);
    EXPECT_TRUE(s.result.failure.starts_with("before: "));
    EXPECT_TRUE(std::isnan(s.graspability_before));
    EXPECT_TRUE(std::isnan(s.change.hausdorff));
    EXPECT_EQ(s.pairs_before, -1);
  }
}

TEST(PerturbAndScore, EveryNumberIsOfItsOwnMesh) {
  // Three boxes that nothing confuses: the object, what the algorithm began on, what it made.
  const TriangleMesh object = shapes::Box({1.0, 2.0, 3.0});
  const TriangleMesh start = shapes::Box({1.0, 2.75, 3.0});
  TriangleMesh made = start;
  for (Eigen::Vector3d& v : made.vertices) {
    if (v.x() > 0 && v.z() > 0) v.z() += std::tan(0.1);  // the top tilts by 0.1 rad
  }
  made = InSinglePrecision(made);
  PerturbSettings settings = Quick(1);
  settings.seed = 5;
  settings.metric.friction = 0.3;
  settings.metric.object_min_extent = 0.04;
  settings.common.max_width = 0.1;
  settings.common.history = true;
  std::uint64_t drawn = 0;
  settings.method = [&](const TriangleMesh& mesh, const PairLimits& pairs,
                        const PerturbOptions& common, RngStream* rng, const ProgressFn& progress) {
    EXPECT_EQ(mesh.vertices, object.vertices);
    EXPECT_NEAR(pairs.cone_angle, std::atan(0.3), 1e-15);
    EXPECT_NEAR(pairs.max_width, 0.1 / 0.04, 1e-12);  // the smallest extent, 1, is 0.04 m
    EXPECT_TRUE(common.history);
    drawn = rng->NextU64();
    progress(3, 9);
    PerturbResult result;
    result.start = start;
    result.mesh = made;
    return result;
  };
  std::int64_t reported = 0;
  const ScoredPerturbation s =
      PerturbAndScore(object, settings, 7,
                      [&](std::int64_t done, std::int64_t total) { reported = 10 * done + total; });
  EXPECT_EQ(reported, 39);
  EXPECT_EQ(drawn, RngStream(5, "perturb", 7).NextU64());
  const auto score = [&](const TriangleMesh& mesh) {
    return EvaluateGraspability(mesh, settings.metric, 5, 7).value;
  };
  EXPECT_EQ(s.before.vertices, object.vertices);
  EXPECT_EQ(s.graspability_before, score(object));
  EXPECT_EQ(s.graspability_after, score(made));
  EXPECT_NE(s.graspability_before, s.graspability_after);
  const PairLimits limits{std::atan(0.3), 2.5};
  EXPECT_EQ(s.pairs_before, CountAntipodalPairs(object, limits));
  EXPECT_EQ(s.pairs_after, CountAntipodalPairs(made, limits));
  EXPECT_NE(s.pairs_before, s.pairs_after);
  // One of six sides, 1 x 2.75 of 2 (2.75 + 3 + 8.25).
  EXPECT_NEAR(s.normals.largest, 0.1 * 180.0 / M_PI, 1e-4);
  EXPECT_NEAR(s.normals.mean, 0.1 * 180.0 / M_PI * 2.75 / 28.0, 1e-4);
  // Half of the tilt's height more over the whole top.
  const double volume = 1.0 * 2.75 * (3.0 + 0.5 * std::tan(0.1));
  EXPECT_NEAR(s.change.volume_change, 100.0 * (volume - 6.0) / 6.0, 1e-4);
}

TEST(KappaReduction, DividesMeansAndNotObjectByObject) {
  // Means 2 and 1.6: a fall by 20 %. (Object by object it is 50 % and 10 %.) Residuals about the
  // ratio 0.8 are (0.5 - 0.8) / 2 and (2.7 - 2.4) / 2, of the mean before: deviation 0.15 sqrt 2,
  // standard error 0.15.
  const MeanInterval fall = KappaReduction({1.0, 3.0}, {0.5, 2.7});
  EXPECT_NEAR(fall.mean, 20.0, 1e-12);
  EXPECT_NEAR(fall.half_width, 1.96 * 15.0, 0.01);
  // The other way it is a rise by a quarter, of the mean that was before.
  const MeanInterval rise = KappaReduction({0.5, 2.7}, {1.0, 3.0});
  EXPECT_NEAR(rise.mean, -25.0, 1e-12);
  EXPECT_NEAR(rise.half_width, 1.96 * 100.0 * (1.0 - 1.25 * 0.5) / 1.6, 0.01);
  // Pairs are left out together: 2 -> 1 and 4 -> 1 are left.
  const double nan = std::nan("");
  const MeanInterval left = KappaReduction({2.0, nan, 4.0, 9.0}, {1.0, 5.0, 1.0, nan});
  EXPECT_NEAR(left.mean, 100.0 * (1.0 - 2.0 / 6.0), 1e-12);
  EXPECT_EQ(left.count, 2);
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

// The four algorithms, each with little to do.
std::vector<PerturbMethod> AllMethods(const MetricOptions& metric) {
  return {[](const auto& mesh, const auto& pairs, const auto& common, auto* rng, const auto& tell) {
            return PerturbRandomly(mesh, pairs, common, {.iterations = 100}, rng, tell);
          },
          [](const auto& mesh, const auto& pairs, const auto& common, auto* rng, const auto& tell) {
            return PerturbByRotation(mesh, pairs, common, {.max_faces = 60}, rng, tell);
          },
          [](const auto& mesh, const auto& pairs, const auto& common, auto* rng, const auto& tell) {
            return PerturbExhaustively(mesh, pairs, common, {.iterations = 2}, rng, tell);
          },
          [metric](const auto& mesh, const auto&, const auto&, auto* rng, const auto& tell) {
            SearchOptions options;
            options.steps = 4;
            return PerturbBySearch(mesh, metric, options, rng, tell);
          }};
}

TEST(PerturbAndScore, GivesOneResultForAnObjectWhereverItLies) {
  // Millimetres whose fractions end at 2^-18, so that moving loses nothing: what single precision
  // at 800 m would leave of them are sixteenths.
  TriangleMesh near = shapes::Cylinder(30.0, 110.0, 32);
  for (Eigen::Vector3d& v : near.vertices) {
    v = (v * 0x1p18).array().round() * 0x1p-18 + Eigen::Vector3d(0.0, 0.0, 55.0).array();
  }
  PerturbSettings settings = Quick(1);
  for (const PerturbMethod& method : AllMethods(settings.metric)) {
    settings.method = method;
    const ScoredPerturbation a = PerturbAndScore(near, settings, 3);
    EXPECT_EQ(a.result.failure, "");
    EXPECT_NE(a.result.mesh.vertices, a.result.start.vertices);
    for (const Eigen::Vector3d& place :
         {Eigen::Vector3d(10000.0, 8000.0, 500.0), Eigen::Vector3d(400000.0, -800000.0, 0.0)}) {
      const ScoredPerturbation b = PerturbAndScore(Transformed(near, 1.0, place), settings, 3);
      EXPECT_EQ(b.graspability_before, a.graspability_before);
      EXPECT_EQ(b.graspability_after, a.graspability_after);
      EXPECT_EQ(b.pairs_after, a.pairs_after);
      EXPECT_EQ(b.normals.mean, a.normals.mean);
      EXPECT_EQ(b.change.hausdorff, a.change.hausdorff);
      // And the meshes lie where the object lies.
      EXPECT_EQ(b.result.mesh.vertices, Transformed(a.result.mesh, 1.0, place).vertices);
      EXPECT_EQ(b.result.start.vertices, Transformed(a.result.start, 1.0, place).vertices);
      EXPECT_EQ(b.before.vertices, Transformed(a.before, 1.0, place).vertices);
    }
  }
}

}  // namespace
}  // namespace antigrasp
