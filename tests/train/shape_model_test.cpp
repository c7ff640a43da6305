// Another model than the GAN in the loop: spheres whose radius is known on paper.
#include "antigrasp/train/shape_model.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/cem_loop.h"
#include "antigrasp/train/cem_run.h"
#include "antigrasp/train/elites.h"
#include "antigrasp/train/scalar_log.h"
#include "antigrasp/train/statistics_table.h"
#include "tests/support/csv_rows.h"
#include "tests/support/temp_folder.h"
#include "tests/train/run_files.h"
#include "tests/train/sphere_model.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::CsvRows;
using shapes::ExpectSameFiles;
using shapes::MakeSpheres;
using shapes::SphereModel;
using shapes::StoppingObserver;
using shapes::TempFolder;

constexpr double kHalf = 1e-4;                // what float16 leaves of a radius
const double kTen = std::pow(7.0 / 8.0, 10);  // the part of a gap that ten steps leave

// Spheres of radius 0.2, 0.21, ... 0.27: 0.235 in the mean.
ShapeSet Spheres() {
  ShapeSet set;
  set.kind = "import";
  for (int i = 0; i < 8; ++i) {
    SdfGrid grid = UnitCubeGrid();
    const torch::Tensor values = 0.2 + 0.01 * i - shapes::Radii(grid.n);
    grid.values.assign(values.data_ptr<float>(), values.data_ptr<float>() + values.numel());
    set.names.push_back("sphere-" + std::to_string(i));
    set.grids.push_back(grid);
  }
  return set;
}

RunConfig TinySpheres() {
  RunConfig config = shapes::Tiny();
  config.cem.prior_iterations = 20;
  config.cem.iterations = 10;
  config.cem.prior_fraction = 0.0;
  return config;
}

// The same with the spheres as a file.
RunConfig WithPrior(const TempFolder& folder, RunConfig config) {
  config.prior_file = (folder / "spheres.h5").string();
  WriteShapeSet(config.prior_file, Spheres());
  return config;
}

SphereModel StateOf(const RunConfig& config, const fs::path& checkpoint) {
  SphereModel model(config);
  model.Load(ReadCheckpoint(checkpoint).networks, checkpoint.string());
  return model;
}

// The mean radius of these samples of an episode.
double MeanRadius(const SphereModel& model, const RunConfig& config,
                  const std::vector<std::int64_t>& samples) {
  const torch::Tensor z = model.Latents(StageSeed(config, model.episode()), 0, config.cem.samples);
  double sum = 0.0;
  for (const std::int64_t i : samples) {
    sum += SphereModel::RadiusOf(model.radius(), z[i][0].item<double>());
  }
  return sum / static_cast<double>(samples.size());
}

std::vector<std::int64_t> ElitesOf(const RunFolder& run, int episode) {
  std::vector<std::int64_t> elites;
  for (const std::string& name : ReadShapeNames(run.Episode(episode) / "elites.h5")) {
    elites.push_back(std::stol(name.substr(std::string("sample-").size())));
  }
  return elites;
}

TEST(ShapeModel, SpheresGoThroughARunWithTheirOwnScalars) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = WithPrior(folder, TinySpheres());
  config.cem.control = true;
  const RunResult result = StartRun(config, folder / "run", &observer, MakeSpheres);
  const RunFolder run{folder / "run"};
  ASSERT_EQ(result.stages.size(), 4U);
  for (const StageStatistics& row : result.stages) EXPECT_EQ(row.rejected(), 0) << row.stage;
  EXPECT_EQ(ReadFile(run.Statistics()), StatisticsToCsv(result.stages));

  // Episode 0 starts 0.135 below the prior set's mean radius, 0.235. The gap of a row is the one
  // before its step.
  const auto losses = CsvRows(run.Episode(0) / "losses.csv");
  EXPECT_TRUE(ReadFile(run.Episode(0) / "losses.csv").starts_with("step,radius,gap\n10,"));
  ASSERT_EQ(losses.size(), 2U);
  EXPECT_EQ(losses[1].at("step"), "20");
  EXPECT_NEAR(std::stod(losses[0].at("radius")), 0.235 - 0.135 * kTen, kHalf);
  EXPECT_NEAR(std::stod(losses[0].at("gap")), 0.135 * kTen * 8 / 7, kHalf);
  EXPECT_NEAR(std::stod(losses[1].at("radius")), 0.235 - 0.135 * kTen * kTen, kHalf);
  std::vector<float> radii, gaps;
  for (const ScalarEvent& event : ReadScalarEvents(run.Events())) {
    if (event.step > 20) break;
    if (event.tag == "training/radius") radii.push_back(event.value);
    if (event.tag == "training/gap") gaps.push_back(event.value);
  }
  for (const char* name : {"radius", "gap"}) {
    const std::vector<float>& events = name[0] == 'r' ? radii : gaps;
    ASSERT_EQ(events.size(), 2U) << name;
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(events[i], std::stof(losses[i].at(name))) << name;
  }
  EXPECT_EQ(ReadCheckpoint(run.EpisodeCheckpoint(0)).losses.sizes(), (torch::IntArrayRef{2, 3}));

  // Episode 1 goes on from there towards the mean of the elites; so does that of the control.
  for (const RunFolder& of : {run, RunFolder{run.Control()}}) {
    const SphereModel first = StateOf(config, run.EpisodeCheckpoint(0));
    const SphereModel second = StateOf(config, of.EpisodeCheckpoint(1));
    const std::vector<std::int64_t> elites = ElitesOf(of, 0);
    ASSERT_EQ(std::ssize(elites), config.cem.keep);
    const double target = MeanRadius(first, config, elites);
    EXPECT_NEAR(second.radius(), target + (first.radius() - target) * kTen, kHalf);
  }
}

TEST(ShapeModel, SpheresGiveEqualBytesAfterAnyInterruption) {
  const TempFolder folder;
  StoppingObserver never;
  const RunConfig config = WithPrior(folder, TinySpheres());
  StartRun(config, folder / "a", &never, MakeSpheres);
  shapes::RunWithStops(config, folder / "stopped",
                       {{4 + 13, "episode 0: training"},
                        {7 + 1 + 3, "episode 0: scoring"},
                        {1 + 8 + 5, "episode 1: training"}},
                       MakeSpheres);
  ExpectSameFiles(folder / "a", folder / "stopped");
}

// The network values that elites.h5 of an episode gives to whoever trains on it.
torch::Tensor EliteValues(const RunFolder& run, int episode, const RunConfig& config) {
  return NetworkValuesOf(ReadShapeSet(run.Elites(episode)), config.model, "elites.h5");
}

TEST(ShapeModel, ElitesOnFileAreBitForBitWhatTheNextEpisodeLearnsFrom) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = WithPrior(folder, TinySpheres());
  config.cem.redistance = true;
  config.cem.prior_fraction = 0.5;
  config.cem.episodes = 1;
  StartRun(config, folder / "run", &observer, MakeSpheres);
  const RunFolder run{folder / "run"};
  const torch::Tensor learnt = ReadCheckpoint(run.EpisodeCheckpoint(1)).shapes;
  ASSERT_EQ(learnt.size(0), 5);  // three elites and two of the prior set
  EXPECT_TRUE(torch::equal(EliteValues(run, 0, config), learnt.slice(0, 0, 3)));
  // They are the distances to the meshes, a little off those that were sampled.
  config.cem.redistance = false;
  StartRun(config, folder / "sampled", &observer, MakeSpheres);
  const torch::Tensor sampled = EliteValues(RunFolder{folder / "sampled"}, 0, config);
  const double off = (sampled - learnt.slice(0, 0, 3)).abs().max().item<double>();
  EXPECT_GT(off, 0.0);
  EXPECT_LT(off, 0.05);
}

TEST(ShapeModel, LatentModeMovesTheNoiseOfSpheres) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = WithPrior(folder, TinySpheres());
  config.cem.mode = EpisodeMode::kLatent;
  StartRun(config, folder / "run", &observer, MakeSpheres);
  const RunFolder run{folder / "run"};
  const SphereModel first = StateOf(config, run.EpisodeCheckpoint(0));
  const SphereModel second = StateOf(config, run.EpisodeCheckpoint(1));
  EXPECT_EQ(second.radius(), first.radius());
  EXPECT_EQ(second.latent().means.size(0), config.cem.keep);
  EXPECT_EQ(ReadFile(run.Episode(1) / "losses.csv"), "step,radius,gap\n");
}

TEST(ShapeModel, ACheckpointOfAnotherModelIsRefused) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = WithPrior(folder, TinySpheres());
  config.cem.episodes = 0;
  StartRun(config, folder / "run", &observer, MakeSpheres);
  const RunFolder run{folder / "run"};
  try {
    ResumeRun(run.root, &observer);
    FAIL() << "the GAN went on with spheres";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "networks of another shape model (" + run.Latest().string() +
                  "): expected those of a GAN (average/..., discriminator/...)");
  }
  // Its tensors, but losses of the GAN.
  Checkpoint checkpoint = ReadCheckpoint(run.Latest());
  checkpoint.losses = torch::zeros({2, 8}, torch::kDouble);
  WriteCheckpoint(run.Latest(), checkpoint);
  try {
    ResumeRun(run.root, &observer, MakeSpheres);
    FAIL() << "losses of another model were accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("losses of another shape"), std::string::npos)
        << error.what();
  }
}

// The radius in place of the graspability.
ScoredStage ScoreRadius(const SphereModel& model, const torch::Tensor& values) {
  ScoredStage scored;
  scored.values = values;
  for (std::int64_t i = 0; i < values.size(0); ++i) {
    RemeshResult object;
    object.status = RemeshStatus::kOk;
    Graspability score;
    score.status = GraspabilityStatus::kOk;
    score.value = model.MeanRadius(values.slice(0, i, i + 1));
    scored.graspabilities.push_back(score.value);
    scored.objects.push_back(object);
    scored.scores.push_back(score);
  }
  return scored;
}

TEST(CemLoop, IsSteppedWithoutAFolderByAnyScore) {
  RunConfig config = TinySpheres();
  config.cem.episodes = 1;
  StoppingObserver observer;
  SphereModel model(config);
  std::vector<std::string> scored;
  CemLoop loop(
      config, &model, NetworkValuesOf(Spheres(), config.model, "spheres"),
      [&](const torch::Tensor& values, const std::string& name) {
        scored.push_back(name);
        return ScoreRadius(model, values);
      },
      &observer);
  loop.Begin();
  loop.ScorePrior("spheres");
  ASSERT_EQ(loop.rows().size(), 1U);
  EXPECT_NEAR(loop.rows()[0].graspability.mean, 0.215, kHalf);  // the first four
  int steps = 0;
  for (; !loop.trained(); ++steps) loop.TrainStep();
  EXPECT_EQ(steps, 20);
  EXPECT_EQ(loop.UpdatesSoFar(), 20);
  EXPECT_NEAR(model.radius(), 0.235 - 0.135 * kTen * kTen, kHalf);

  // The radius grows with z_0: the elites are the three least of them.
  const torch::Tensor z = model.Latents(StageSeed(config, 0), 0, config.cem.samples);
  std::vector<double> z0;
  for (std::int64_t i = 0; i < z.size(0); ++i) z0.push_back(z[i][0].item<double>());
  const std::vector<std::int64_t> least = LeastGraspable(z0, 3);
  const double r = model.radius(), target = MeanRadius(model, config, least);
  const Episode episode = loop.Finish();
  EXPECT_EQ(episode.selection.elites, least);
  std::sort(z0.begin(), z0.end());
  EXPECT_EQ(episode.row.stage, 0);
  EXPECT_EQ(episode.row.samples, 8);
  EXPECT_NEAR(episode.row.elite_threshold, SphereModel::RadiusOf(r, z0[2]), kHalf);
  EXPECT_FALSE(loop.last());

  loop.Next(episode);
  EXPECT_EQ(model.episode(), 1);
  EXPECT_EQ(loop.shapes().sizes(), (torch::IntArrayRef{3, 1, 32, 32, 32}));
  while (!loop.trained()) loop.TrainStep();
  EXPECT_EQ(loop.UpdatesSoFar(), 30);
  EXPECT_NEAR(model.radius(), target + (r - target) * kTen, kHalf);
  EXPECT_TRUE(loop.last());
  loop.Finish();
  ASSERT_EQ(loop.rows().size(), 3U);
  EXPECT_LT(loop.rows()[2].graspability.mean, loop.rows()[1].graspability.mean);
  EXPECT_EQ(scored, (std::vector<std::string>{"scoring the prior set", "episode 0: scoring",
                                              "episode 1: scoring"}));
}

TEST(CemLoop, WithThePapersScoreItIsTheRunInAFolder) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunConfig config = WithPrior(folder, TinySpheres());
  const RunResult run = StartRun(config, folder / "run", &observer, MakeSpheres);
  SphereModel model(config);
  CemLoop loop(config, &model, NetworkValuesOf(Spheres(), config.model, "spheres"),
               GraspabilityScorer(config, &observer), &observer);
  loop.Begin();
  loop.ScorePrior("spheres");
  while (true) {
    while (!loop.trained()) loop.TrainStep();
    const Episode episode = loop.Finish();
    if (loop.last()) break;
    loop.Next(episode);
  }
  EXPECT_EQ(StatisticsToCsv(loop.rows()), StatisticsToCsv(run.stages));
}

TEST(CemLoop, SaysWhenThereIsNothingUsable) {
  const RunConfig config = TinySpheres();
  StoppingObserver observer;
  SphereModel model(config);
  const auto nothing = [&](const torch::Tensor& values, const std::string&) {
    ScoredStage scored = ScoreRadius(model, values);
    for (std::size_t i = 0; i < scored.objects.size(); ++i) {
      scored.objects[i].status = RemeshStatus::kGaps;
      scored.scores[i].status = GraspabilityStatus::kNotEvaluable;
      scored.graspabilities[i] = std::nan("");
    }
    return scored;
  };
  CemLoop loop(config, &model, NetworkValuesOf(Spheres(), config.model, "spheres"), nothing,
               &observer);
  loop.Begin();
  try {
    loop.ScorePrior("my spheres");
    FAIL() << "a prior set without a usable shape was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("my spheres"), std::string::npos) << error.what();
  }
  try {
    loop.Finish();
    FAIL() << "an episode without a usable sample was accepted";
  } catch (const RuntimeFailure& failure) {
    EXPECT_STREQ(failure.what(), "episode 0: none of 8 samples is a usable object");
  }
  EXPECT_TRUE(loop.rows().empty());
}

}  // namespace
}  // namespace antigrasp
