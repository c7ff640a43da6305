#include "antigrasp/train/selection.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "antigrasp/core/rng.h"
#include "antigrasp/sdf/remesh.h"
#include "antigrasp/sdf/sdf_grid.h"
#include "antigrasp/train/elites.h"

namespace antigrasp {
namespace {

constexpr int kFamilies = 4, kEach = 10;

// Network values of `count` shapes of a family: far from the other families, near each other.
torch::Tensor Family(int family, int count, double jitter) {
  torch::Tensor values = torch::zeros({count, 1, 4, 4, 4});
  values.select(2, family).fill_(1.0);
  for (int i = 0; i < count; ++i) values[i].view(-1)[i] += jitter;
  return values;
}

torch::Tensor Prior() {
  std::vector<torch::Tensor> families;
  for (int f = 0; f < kFamilies; ++f) families.push_back(Family(f, kEach, 0.01));
  return torch::cat(families).to(torch::kHalf);
}

// 20 samples of the first family, hard to grasp, and 4 of the second.
ScoredStage Stage() {
  ScoredStage scored;
  scored.values = torch::cat({Family(0, 20, 0.02), Family(1, 4, 0.02)});
  for (int i = 0; i < 24; ++i) scored.graspabilities.push_back(0.001 * (i + 1));
  return scored;
}

SdfGrid Ball(double radius) {
  SdfGrid grid = UnitCubeGrid();
  for (int z = 0; z < grid.n; ++z) {
    for (int y = 0; y < grid.n; ++y) {
      for (int x = 0; x < grid.n; ++x) {
        grid.values[grid.Index(x, y, z)] = static_cast<float>(radius - grid.Node(x, y, z).norm());
      }
    }
  }
  return grid;
}

torch::Tensor ValuesOf(const SdfGrid& grid) {
  ShapeSet set;
  set.grids = {grid};
  return NetworkValuesOf(set, ModelOptions(), "");
}

RunConfig Config(EliteRule variant) {
  RunConfig config;
  config.cem.variant = variant;
  config.cem.samples = 24;
  config.cem.keep = 8;
  config.cem.cells = kFamilies * kEach;  // every prior shape is a cell
  return config;
}

torch::Tensor Learnt(const EliteSelector& selector, const ScoredStage& scored,
                     const Selection& selection) {
  return selector.TrainingSet(selector.Elites(scored, selection, 1, nullptr), selection);
}

// The second family is beaten by all of the first, but is like none of it.
TEST(EliteSelector, DiverseKeepsWhatIsUnlikeAllThatIsLessGraspable) {
  RunConfig config = Config(EliteRule::kDiverse);
  config.cem.neighbours = 1;
  config.cem.keep = 2;
  const EliteSelector selector(config, Prior());
  EXPECT_EQ(selector.Select(Stage(), 1).elites, (std::vector<std::int64_t>{0, 20}));
  config.cem.select = EliteOrder::kRandom;
  const std::vector<std::int64_t> random = selector.Select(Stage(), 1).elites;
  ASSERT_EQ(random.size(), 2U);
  EXPECT_NE(random.front() < 20, random.back() < 20);  // one of either family
}

// Prior shapes are .014 from their nearest, samples of theirs .022, half a family away 2.8.
TEST(EliteSelector, KeepsNoSampleBeyondTheSpreadOfThePriorSet) {
  for (const EliteRule rule : {EliteRule::kPaper, EliteRule::kStratified, EliteRule::kDiverse}) {
    RunConfig config = Config(rule);
    config.cem.keep = 24;
    ScoredStage scored = Stage();
    scored.values = torch::cat({Family(0, 20, 0.01), Family(1, 4, 0.01)});
    scored.values.slice(0, 0, 5).mul_(0.5);
    const std::vector<std::int64_t> near = {5,  6,  7,  8,  9,  10, 11, 12, 13, 14,
                                            15, 16, 17, 18, 19, 20, 21, 22, 23};
    const EliteSelector any(config, Prior());
    const Selection all = any.Select(scored, 1);
    EXPECT_EQ(all.outside, 0);
    if (rule != EliteRule::kStratified) {
      EXPECT_EQ(all.elites.size(), 24U);
    }
    config.cem.spread = 95.0;
    const EliteSelector selector(config, Prior());
    const Selection selection = selector.Select(scored, 1);
    EXPECT_EQ(selection.outside, 5);
    if (rule == EliteRule::kStratified) {
      for (const std::int64_t i : selection.elites) EXPECT_GE(i, 5);
    } else {
      EXPECT_EQ(selection.elites, near);
    }
  }
}

TEST(EliteSelector, OfThePaperKeepsTheLeastGraspableHoweverAlikeTheyAre) {
  const RunConfig config = Config(EliteRule::kPaper);
  const EliteSelector selector(config, Prior());
  const Selection selection = selector.Select(Stage(), 1);
  EXPECT_EQ(selection.elites, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_TRUE(selection.replayed.empty());
  EXPECT_EQ(Learnt(selector, Stage(), selection).size(0), 8);
}

TEST(EliteSelector, StratifiedKeepsThePriorsSharesAndReplaysWhatIsMissing) {
  RunConfig config = Config(EliteRule::kStratified);
  config.cem.keep = 40;
  const EliteSelector selector(config, Prior());
  const Selection selection = selector.Select(Stage(), 1);
  EXPECT_EQ(selection.elites.size() + selection.replayed.size(), 40U);
  const torch::Tensor set = Learnt(selector, Stage(), selection).to(torch::kFloat);
  for (int f = 0; f < kFamilies; ++f) {
    const auto members = (set.select(2, f).flatten(1).mean(1) > 0.5).sum().item<std::int64_t>();
    EXPECT_EQ(members, kEach) << "family " << f;
  }
  for (const std::int64_t i : selection.replayed) {
    EXPECT_GE(i, 0);
    EXPECT_LT(i, kFamilies * kEach);
  }
}

TEST(EliteSelector, MixesInTheAskedShareOfThePriorSet) {
  RunConfig config = Config(EliteRule::kPaper);
  config.cem.prior_fraction = 0.5;
  const EliteSelector selector(config, Prior());
  const Selection first = selector.Select(Stage(), 1), second = selector.Select(Stage(), 2);
  EXPECT_EQ(first.replayed.size(), 4U);
  EXPECT_EQ(std::set<std::int64_t>(first.replayed.begin(), first.replayed.end()).size(), 4U);
  EXPECT_NE(first.replayed, second.replayed) << "every episode draws anew";
  EXPECT_EQ(Learnt(selector, Stage(), first).size(0), 12);
}

TEST(EliteSelector, RedistancesElitesToTheirMeshes) {
  RunConfig config;
  config.cem.samples = 2;
  config.cem.keep = 1;
  config.cem.redistance = true;
  const SdfGrid ball = Ball(0.3);
  ScoredStage scored;
  SdfGrid steep = ball;  // the same surface, values four times too large
  for (float& value : steep.values) value *= 4.0F;
  scored.values = torch::cat({ValuesOf(Ball(0.2)), ValuesOf(steep)});
  scored.objects = {Remesh(Ball(0.2)), Remesh(steep)};
  scored.graspabilities = {0.002, 0.001};
  const torch::Tensor prior = ValuesOf(ball);
  const EliteSelector selector(config, prior);
  const Selection selection = selector.Select(scored, 0);
  const torch::Tensor learnt = Learnt(selector, scored, selection);
  EXPECT_EQ(learnt.size(0), 1);
  EXPECT_EQ(learnt.scalar_type(), torch::kHalf);
  EXPECT_LT((learnt - prior).abs().max().item<double>(), 0.03);  // of 0.1: 0.003 of the cube
  EXPECT_GT((scored.values[1] - prior[0]).abs().max().item<double>(), 0.5);
}

// Two balls, of which the second is the elite.
ScoredStage TwoBalls() {
  ScoredStage scored;
  scored.values = torch::cat({ValuesOf(Ball(0.2)), ValuesOf(Ball(0.3))});
  scored.objects = {Remesh(Ball(0.2)), Remesh(Ball(0.3))};
  scored.graspabilities = {0.002, 0.001};
  return scored;
}

TEST(EliteSelector, LearnsTheDistancesToElitesAsTheyWereRefined) {
  RunConfig config;
  config.cem.samples = 2;
  config.cem.keep = 1;
  config.cem.refine_steps = 5;
  const ScoredStage scored = TwoBalls();
  std::vector<std::uint64_t> seeds;
  const auto refine = [&](const TriangleMesh& mesh, const RunConfig& of, const BoundingBox& within,
                          std::uint64_t seed) {
    EXPECT_EQ(mesh.vertices, scored.objects[1].mesh.vertices);
    EXPECT_EQ(of.cem.refine_steps, 5);
    // A node from each side of the 32.
    EXPECT_NEAR(within.min.x(), -0.5 + 1.5 / 32, 1e-12);
    EXPECT_NEAR(within.max.z(), 0.5 - 1.5 / 32, 1e-12);
    seeds.push_back(seed);
    return scored.objects[0].mesh;
  };
  const EliteSelector selector(config, ValuesOf(Ball(0.3)), InThreads(refine));
  const Selection selection = selector.Select(scored, 0);
  const torch::Tensor first = selector.Elites(scored, selection, 1, nullptr);
  EXPECT_EQ(first.size(0), 1);
  EXPECT_LT((first - ValuesOf(Ball(0.2))).abs().max().item<double>(), 0.03);
  selector.Elites(scored, selection, 2, nullptr);
  ASSERT_EQ(seeds.size(), 2U);
  EXPECT_NE(seeds[0], seeds[1]) << "every episode begins elsewhere";
}

TEST(EliteSelector, TrainsOnTheElitesOfTheSamplesAndThenTheReplayedOfThePriorSet) {
  const RunConfig config = Config(EliteRule::kPaper);
  const torch::Tensor prior = Prior();
  const ScoredStage stage = Stage();
  const torch::Tensor set = Learnt(EliteSelector(config, prior), stage, {{1, 21}, {0, 37, 5}});
  ASSERT_EQ(set.size(0), 5);
  EXPECT_TRUE(torch::equal(set[0], stage.values[1].to(torch::kHalf)));
  EXPECT_TRUE(torch::equal(set[1], stage.values[21].to(torch::kHalf)));
  EXPECT_TRUE(torch::equal(set[2], prior[0]));
  EXPECT_TRUE(torch::equal(set[3], prior[37]));
  EXPECT_TRUE(torch::equal(set[4], prior[5]));
}

using Indices = std::vector<std::int64_t>;

// `count` of `from`, as a stream draws them: the lowest of one uniform number each.
Indices Drawn(const Indices& from, std::int64_t count, RngStream rng) {
  Indices drawn;
  for (const std::int64_t i :
       LeastGraspable(RandomOrder(std::vector<double>(from.size()), &rng), count)) {
    drawn.push_back(from[static_cast<std::size_t>(i)]);
  }
  return drawn;
}

Indices UpTo(std::int64_t count) {
  Indices indices;
  for (std::int64_t i = 0; i < count; ++i) indices.push_back(i);
  return indices;
}

// The prior's 40 shapes in a row, and samples of which none is usable.
torch::Tensor Row() { return torch::arange(40.0).reshape({40, 1, 1, 1, 1}).to(torch::kHalf); }

ScoredStage Unusable() {
  ScoredStage scored;
  scored.values = torch::zeros({3, 1, 1, 1, 1});
  scored.graspabilities.assign(3, std::nan(""));
  return scored;
}

TEST(EliteSelector, CutsThePriorSetIntoCellsAroundShapesOfAStreamOfTheirOwn) {
  RunConfig config = Config(EliteRule::kStratified);
  config.seed = 7;
  config.cem.cells = 2;
  config.cem.keep = 40;  // the share of a cell is all its shapes
  // In a row the cells meet halfway between the two chosen shapes; on a tie the first has it.
  const Indices centres = Drawn(UpTo(40), 2, RngStream(7, "cells"));
  Indices expected = UpTo(40);
  EXPECT_EQ(EliteSelector(config, Row()).Select(Unusable(), 1).replayed, expected);
  config.cem.keep = 20;
  const std::int64_t first = (centres[0] + centres[1]) / 2 + 1, half = (first + 1) / 2;
  ASSERT_GT(half, 1);
  ASSERT_GT(20 - half, 1);
  const Indices all = UpTo(40), in_first(all.begin(), all.begin() + first),
                in_second(all.begin() + first, all.end());
  for (const std::uint64_t episode : {1, 2}) {
    expected = Drawn(in_first, half, RngStream(7, "stand-in", episode, 0));
    const Indices others = Drawn(in_second, 20 - half, RngStream(7, "stand-in", episode, 1));
    expected.insert(expected.end(), others.begin(), others.end());
    EXPECT_EQ(EliteSelector(config, Row()).Select(Unusable(), static_cast<int>(episode)).replayed,
              expected)
        << episode;
  }
}

TEST(EliteSelector, ReplaysAShareOfTheElitesThatThereAreFromAStreamOfItsOwn) {
  RunConfig config = Config(EliteRule::kPaper);
  config.seed = 7;
  config.cem.prior_fraction = 0.75;
  ScoredStage stage = Stage();
  for (std::size_t i = 4; i < stage.graspabilities.size(); ++i) {
    stage.graspabilities[i] = std::nan("");
  }
  const Selection selection = EliteSelector(config, Prior()).Select(stage, 2);
  EXPECT_EQ(selection.elites, UpTo(4));
  EXPECT_EQ(selection.replayed, Drawn(UpTo(40), 3, RngStream(7, "replay", 2)));
}

TEST(EliteSelector, OfTheControlDrawsElitesFromAStreamOfItsOwn) {
  RunConfig config = Config(EliteRule::kPaper);
  config.seed = 7;
  config.cem.select = EliteOrder::kRandom;
  const Selection selection = EliteSelector(config, Prior()).Select(Stage(), 2);
  EXPECT_EQ(selection.elites, Drawn(UpTo(24), 8, RngStream(7, "control", 2)));
}

TEST(EliteSelector, OfTheControlDrawsOtherElitesInEveryEpisode) {
  for (const EliteRule variant : {EliteRule::kPaper, EliteRule::kStratified}) {
    RunConfig config = Config(variant);
    config.cem.select = EliteOrder::kRandom;
    config.cem.cells = kFamilies;
    const EliteSelector selector(config, Prior());
    const Selection first = selector.Select(Stage(), 1), again = selector.Select(Stage(), 1);
    EXPECT_EQ(first.elites, again.elites);
    EXPECT_NE(first.elites, selector.Select(Stage(), 2).elites) << ChoiceName(variant);
    EXPECT_TRUE(std::is_sorted(first.elites.begin(), first.elites.end()));
  }
}

}  // namespace
}  // namespace antigrasp
