#include "antigrasp/train/stage.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <set>

#include "antigrasp/core/error.h"
#include "tests/support/shapes.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

const double kNaN = std::nan("");

Graspability Score(GraspabilityStatus status, double value) {
  Graspability score;
  score.status = status;
  score.value = value;
  return score;
}

RemeshResult Object(RemeshStatus status) {
  RemeshResult object;
  object.status = status;
  return object;
}

TEST(StageScoresCsv, OfAStageHasEveryNumberUnderItsOwnName) {
  ScoredStage scored;
  scored.objects = {Object(RemeshStatus::kOk), Object(RemeshStatus::kDisjoint),
                    Object(RemeshStatus::kOk)};
  scored.scores = {Score(GraspabilityStatus::kFewGrasps, 0.5),
                   Score(GraspabilityStatus::kNotEvaluable, kNaN),
                   Score(GraspabilityStatus::kNoGrasps, 0.0)};
  scored.scores[0].ci_low = 0.25;
  scored.scores[0].ci_high = 0.75;
  scored.scores[0].mean = 0.625;
  scored.scores[0].fraction_nonzero = 0.875;
  scored.scores[0].grasps.resize(3);
  EXPECT_EQ(StageScoresCsv(2, scored),
            "object,status,num_grasps,graspability,ci_low,ci_high,mean,fraction_nonzero\n"
            "sample-000000,few_grasps,3,0.5,0.25,0.75,0.625,0.875\n"
            "sample-000001,disjoint,0,,,,,\n"
            "sample-000002,no_grasps,0,0,0,0,0,0\n");
  // Shapes of the prior set are no samples.
  EXPECT_TRUE(StageScoresCsv(-1, scored).ends_with("\n2,no_grasps,0,0,0,0,0,0\n"));
}

// Network values on a line: shape i is places[i] at one node and 0 elsewhere.
torch::Tensor Line(const std::vector<float>& places) {
  torch::Tensor values = torch::zeros({std::ssize(places), 1, 2, 2, 2});
  values.view({std::ssize(places), 8}).select(1, 3).copy_(torch::tensor(places));
  return values;
}

// Four samples on a line, the second of them rejected.
ScoredStage FourSamples() {
  ScoredStage scored;
  scored.values = Line({0.1F, 1000.0F, 0.3F, 2.0F});
  scored.objects = {Object(RemeshStatus::kOk), Object(RemeshStatus::kGaps),
                    Object(RemeshStatus::kOk), Object(RemeshStatus::kOk)};
  scored.scores = {
      Score(GraspabilityStatus::kOk, 0.2), Score(GraspabilityStatus::kNotEvaluable, kNaN),
      Score(GraspabilityStatus::kNoGrasps, 0.0), Score(GraspabilityStatus::kFewGrasps, 0.4)};
  scored.graspabilities = {0.2, kNaN, 0.0, 0.4};
  return scored;
}

TEST(Summarize, CountsByStatusAndLeavesTheRejectedOutOfTheMean) {
  RunConfig config;
  const StageStatistics row = Summarize(2, FourSamples(), Line({0.0F, 1.0F, 10.0F}), config);
  EXPECT_EQ(row.stage, 2);
  EXPECT_EQ(row.samples, 4);
  EXPECT_EQ(row.by_status, (std::array<int, kNumRemeshStatuses>{3, 0, 0, 0, 1, 0, 0, 0, 0}));
  EXPECT_EQ(row.rejected(), 1);
  EXPECT_EQ(row.scored, 3);
  EXPECT_EQ(row.without_grasps, 1);
  EXPECT_EQ(row.graspability.count, 3);
  EXPECT_NEAR(row.graspability.mean, 0.2, 1e-15);  // of 0.2, 0 and 0.4: deviation 0.2
  EXPECT_NEAR(row.graspability.half_width, 1.96 * 0.2 / std::sqrt(3.0), 1e-5);
  EXPECT_TRUE(std::isnan(row.elite_threshold));
}

TEST(Summarize, ComparesTheUsableSamplesWithAsManyOfThePriorSet) {
  // As in CompareWithPrior.TellsTheSamplesFromTheReference: 0.1, 0.3, 2 against 0, 1, 10.
  RunConfig config;
  const torch::Tensor prior = Line({0.0F, 1.0F, 10.0F, 0.3F, 0.2F});
  StageStatistics row = Summarize(0, FourSamples(), prior, config);
  EXPECT_DOUBLE_EQ(row.coverage, 2.0 / 3);
  EXPECT_DOUBLE_EQ(row.nna, 1.0 / 6);
  EXPECT_DOUBLE_EQ(row.duplicates, 2.0 / 3);
  EXPECT_NEAR(row.diversity, 0.19, 1e-6);
  config.cem.compared = 2;  // 0.1 and 0.3 against 0 and 1
  row = Summarize(0, FourSamples(), prior, config);
  EXPECT_DOUBLE_EQ(row.coverage, 0.5);
  EXPECT_DOUBLE_EQ(row.duplicates, 1.0);
  EXPECT_NEAR(row.diversity, 0.2, 1e-6);
  row = Summarize(-1, FourSamples(), prior, config);  // the prior set itself
  EXPECT_TRUE(std::isnan(row.coverage) && std::isnan(row.nna) && std::isnan(row.duplicates) &&
              std::isnan(row.diversity));
}

TEST(Summarize, AveragesTheSharesOfEdgesOverTheUsableSamples) {
  ScoredStage scored = FourSamples();
  const double right = 12.0 / (12.0 + 6.0 * std::sqrt(2.0));  // a cube's, the others are flat
  for (RemeshResult& object : scored.objects) object.mesh = shapes::Cube();
  scored.objects[2].mesh = shapes::FlatSquare();  // all flat
  scored.objects[1].mesh = {};                    // rejected
  for (const int threads : {1, 4}) {
    RunConfig config;
    config.threads = threads;
    const StageStatistics row = Summarize(-1, scored, Line({0.0F, 1.0F}), config);
    EXPECT_NEAR(row.flat, (2 * (1 - right) + 1) / 3, 1e-12);
    EXPECT_NEAR(row.crease, 2 * right / 3, 1e-12);
  }
  for (RemeshResult& object : scored.objects) object.status = RemeshStatus::kGaps;
  const StageStatistics none = Summarize(-1, scored, Line({0.0F, 1.0F}), RunConfig());
  EXPECT_TRUE(std::isnan(none.flat) && std::isnan(none.crease));
}

TEST(GridOf, KeepsEveryNodeInItsPlace) {
  ShapeSet set;
  set.grids = {UnitCubeGrid()};
  std::vector<float>& distances = set.grids[0].values;
  distances[set.grids[0].Index(1, 2, 3)] = 0.05F;
  distances[set.grids[0].Index(7, 5, 6)] = -0.2F;  // beyond the truncation of 0.1
  const torch::Tensor values = NetworkValuesOf(set, ModelOptions(), "x");
  ASSERT_EQ(values.sizes(), (std::vector<std::int64_t>{1, 1, 32, 32, 32}));
  EXPECT_EQ(values.scalar_type(), torch::kHalf);
  EXPECT_EQ(values[0][0][3][2][1].item<float>(), 0.5F);
  EXPECT_EQ(values[0][0][6][5][7].item<float>(), -1.0F);
  EXPECT_EQ(values.count_nonzero().item<std::int64_t>(), 2);
  const SdfGrid grid = GridOf(values[0], ModelOptions());
  EXPECT_NEAR(grid.values[grid.Index(1, 2, 3)], 0.05F, 1e-7);
  EXPECT_NEAR(grid.values[grid.Index(7, 5, 6)], -0.1F, 1e-7);
}

TEST(NetworkValuesOf, RefusesWhatNoNetworkCanLearnFrom) {
  ShapeSet set;
  EXPECT_THROW(NetworkValuesOf(set, ModelOptions(), "x"), InputError);
  set.grids = {UnitCubeGrid(16)};
  EXPECT_THROW(NetworkValuesOf(set, ModelOptions(), "x"), InputError);
  set.grids = {UnitCubeGrid()};
  set.grids[0].values[5] = std::nanf("");
  EXPECT_THROW(NetworkValuesOf(set, ModelOptions(), "x"), InputError);
}

TEST(StageSeed, IsAnotherOneForEveryEpisodeAndSeed) {
  RunConfig config, other;
  other.seed = 2;
  const std::set<std::uint64_t> seeds = {config.seed,          StageSeed(config, 0),
                                         StageSeed(config, 1), StageSeed(config, 2),
                                         StageSeed(other, 0),  StageSeed(other, 1)};
  EXPECT_EQ(seeds.size(), 6U);
  EXPECT_EQ(StageSeed(config, 1), StageSeed(RunConfig(), 1));
}

// Network values of a ball, [1, n, n, n].
torch::Tensor Ball() {
  ShapeSet set;
  set.grids = {UnitCubeGrid()};
  SdfGrid& grid = set.grids[0];
  for (int z = 0; z < grid.n; ++z) {
    for (int y = 0; y < grid.n; ++y) {
      for (int x = 0; x < grid.n; ++x) {
        grid.values[grid.Index(x, y, z)] = static_cast<float>(0.2 - grid.Node(x, y, z).norm());
      }
    }
  }
  return NetworkValuesOf(set, ModelOptions(), "x")[0];
}

TEST(ScoreStage, DrawsForSampleIFromTheRunsSeedAndI) {
  RunConfig config = shapes::Tiny();
  config.seed = 7;
  config.cem.check_self_intersection = false;
  const torch::Tensor ball = Ball(), none = torch::full_like(ball, -1.0);
  shapes::StoppingObserver observer;
  const ScoredStage scored =
      ScoreStage(torch::stack({ball, none, ball}), config, "scoring", &observer);
  const TriangleMesh mesh = Remesh(GridOf(ball, config.model)).mesh;
  const auto expected = [&](std::uint64_t seed, std::uint64_t object) {
    return EvaluateGraspability(mesh, config.metric, seed, object).value;
  };
  EXPECT_GT(expected(7, 0), 0.0);
  EXPECT_EQ(scored.graspabilities[0], expected(7, 0));
  EXPECT_TRUE(std::isnan(scored.graspabilities[1]));
  EXPECT_EQ(scored.objects[1].status, RemeshStatus::kEmpty);
  EXPECT_EQ(scored.scores[1].status, GraspabilityStatus::kNotEvaluable);
  EXPECT_EQ(scored.graspabilities[2], expected(7, 2));
  EXPECT_EQ(scored.scores[2].value, scored.graspabilities[2]);
  EXPECT_EQ(ScoreSamples(ball.unsqueeze(0), {2}, config, nullptr).scores[0].value, expected(7, 2));
  // Another number or seed gives other draws.
  EXPECT_NE(expected(7, 0), expected(7, 2));
  EXPECT_NE(expected(7, 0), expected(8, 0));
}

TEST(ScoreStageBy, PutsAnyScoreOfAMeshInThePlaceOfTheGraspability) {
  const torch::Tensor ball = Ball(), none = torch::full_like(ball, -1.0);
  const auto extent = [](const TriangleMesh& mesh) { return Bounds(mesh).Extent().maxCoeff(); };
  const ScoredStage scored =
      ScoreStageBy(extent, torch::stack({none, ball}), shapes::Tiny(), nullptr);
  EXPECT_NEAR(scored.graspabilities[1], 0.4, 0.005);  // a sixth of a cell
  EXPECT_EQ(scored.scores[1].value, scored.graspabilities[1]);
  EXPECT_EQ(scored.scores[1].status, GraspabilityStatus::kOk);
  EXPECT_TRUE(std::isnan(scored.graspabilities[0]));
  EXPECT_EQ(scored.objects[0].status, RemeshStatus::kEmpty);
  EXPECT_EQ(scored.scores[0].status, GraspabilityStatus::kNotEvaluable);
  const auto nothing = [](const TriangleMesh&) { return std::nan(""); };
  const ScoredStage rejected = ScoreStageBy(nothing, ball.unsqueeze(0), shapes::Tiny(), nullptr);
  EXPECT_EQ(rejected.scores[0].status, GraspabilityStatus::kNotEvaluable);
}

}  // namespace
}  // namespace antigrasp
