// The modes of a run beside the plain one: the control, latent mode, networks that are given.
#include <gtest/gtest.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/cem_run.h"
#include "antigrasp/train/elites.h"
#include "antigrasp/train/sample_name.h"
#include "antigrasp/train/stage.h"
#include "tests/support/csv_rows.h"
#include "tests/support/temp_folder.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::CsvRows;
using shapes::StoppingObserver;
using shapes::TempFolder;
using shapes::Tiny;

// The graspability of every sample of an episode, NaN for a rejected one.
std::vector<double> ScoresOf(const RunFolder& run, int episode) {
  std::vector<double> scores;
  for (auto row : CsvRows(run.Episode(episode) / "scores.csv")) {
    const std::string& text = row["graspability"];
    scores.push_back(text.empty() ? std::nan("") : std::stod(text));
  }
  return scores;
}

// By the names in elites.h5.
std::vector<std::int64_t> ElitesOf(const RunFolder& run, int episode) {
  std::vector<std::int64_t> elites;
  for (const std::string& name : ReadShapeNames(run.Episode(episode) / "elites.h5")) {
    elites.push_back(SampleIndex(name).value());
  }
  return elites;
}

double Highest(const std::vector<double>& scores, const std::vector<std::int64_t>& elites) {
  double highest = 0.0;
  for (const std::int64_t i : elites) {
    highest = std::max(highest, scores[static_cast<std::size_t>(i)]);
  }
  return highest;
}

TEST(CemRun, SelectionKeepsLowerScoresThanTheControl) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.control = true;
  config.cem.episodes = 1;
  const RunResult result = StartRun(config, folder / "run", &observer);
  const RunFolder run{folder / "run"}, control{run.Control()};
  EXPECT_EQ(ConfigOfRun(run.root).cem.select, EliteOrder::kGraspability);
  EXPECT_EQ(ConfigOfRun(control.root).cem.select, EliteOrder::kRandom);
  EXPECT_FALSE(ConfigOfRun(control.root).cem.control);
  ASSERT_EQ(result.stages.size(), 3U);
  ASSERT_EQ(result.control.size(), 3U);
  // Both forks begin with the same networks: the same samples, the same scores.
  EXPECT_EQ(result.control[1].graspability.mean, result.stages[1].graspability.mean);
  const std::vector<double> scores = ScoresOf(run, 0), same = ScoresOf(control, 0);
  // Selection keeps the least of the scores, the control what the stream "control" draws.
  RngStream chance(config.seed, "control", 0);
  const auto least = LeastGraspable(scores, config.cem.keep);
  const auto drawn = LeastGraspable(RandomOrder(same, &chance), config.cem.keep);
  EXPECT_EQ(ElitesOf(run, 0), least);
  EXPECT_EQ(ElitesOf(control, 0), drawn);
  EXPECT_NE(least, drawn);
  EXPECT_EQ(result.stages[1].elite_threshold, Highest(scores, least));
  EXPECT_EQ(result.control[1].elite_threshold, Highest(same, drawn));
  EXPECT_LT(result.stages[1].elite_threshold, result.control[1].elite_threshold);
  // Other elites, other networks.
  EXPECT_NE(ScoresOf(run, 1), ScoresOf(control, 1));
}

RunConfig Latent() {
  RunConfig config = Tiny();
  config.cem.mode = EpisodeMode::kLatent;
  return config;
}

TEST(CemRun, LatentModeMovesTheNoiseAndLeavesTheNetworksAlone) {
  const TempFolder folder;
  StoppingObserver observer;
  StartRun(Latent(), folder / "run", &observer);
  const RunFolder run{folder / "run"};
  const RunConfig config = ConfigOfRun(run.root);
  GanTrainer first = MakeTrainer(config), middle = MakeTrainer(config), last = MakeTrainer(config);
  first.LoadNetworks(ReadCheckpoint(run.EpisodeCheckpoint(0)).networks, "first");
  middle.LoadNetworks(ReadCheckpoint(run.EpisodeCheckpoint(1)).networks, "middle");
  last.LoadNetworks(ReadCheckpoint(run.EpisodeCheckpoint(2)).networks, "last");
  EXPECT_EQ(first.latent().means.abs().max().item<double>(), 0.0);
  EXPECT_FALSE(torch::equal(first.Sample(1, 0, 4), last.Sample(1, 0, 4)));
  // z of an episode lies around the z of the elites of the episode before, and a component of
  // fresh z comes last.
  const auto expect_around = [&](GanTrainer& of, GanTrainer& before, int episode) {
    const std::vector<std::int64_t> elites = ElitesOf(run, episode);
    const torch::Tensor z = before.Latents(StageSeed(config, episode), 0, config.cem.samples)
                                .index_select(0, torch::tensor(elites, torch::kLong));
    const torch::Tensor means = of.latent().means;
    ASSERT_EQ(means.size(0), std::ssize(elites) + 1);
    const double shrunk = std::sqrt(1.0 - config.cem.step * config.cem.step);
    EXPECT_LT((means.slice(0, 0, means.size(0) - 1) - shrunk * z).abs().max().item<double>(), 1e-6);
    EXPECT_GT(z.abs().max().item<double>(), 0.1);
    EXPECT_EQ(means[means.size(0) - 1].abs().max().item<double>(), 0.0);
    EXPECT_NEAR(of.latent().deviations[0][0].item<double>(), config.cem.step, 1e-7);
    const double fresh = config.cem.prior_fraction / (1.0 + config.cem.prior_fraction);
    EXPECT_NEAR(of.latent().weights[-1].item<double>(), fresh, 1e-6);
  };
  expect_around(middle, first, 0);
  expect_around(last, middle, 1);
  last.BeginFixedEpisode(0, first.latent());
  EXPECT_TRUE(torch::equal(first.Sample(1, 0, 4), last.Sample(1, 0, 4)));
}

// A run of episode 0 alone, to begin others with.
RunResult TrainPrior(const fs::path& run) {
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  return StartRun(config, run, &observer);
}

TEST(CemRun, BeginsWithGivenNetworksInsteadOfTrainingThem) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult prior = TrainPrior(folder / "prior");
  RunConfig config = Tiny();
  config.start = (folder / "prior").string();
  config.cem.episodes = 1;
  const RunResult result = StartRun(config, folder / "run", &observer);
  ASSERT_EQ(result.stages.size(), 3U);
  EXPECT_EQ(result.stages[1].graspability.mean, prior.stages[1].graspability.mean);

  config.model.width = 8;
  try {
    StartRun(config, folder / "other", &observer);
    FAIL() << "networks of another width were accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("width = 4"), std::string::npos) << error.what();
  }
  config.start = "no-such-networks";
  EXPECT_THROW(StartRun(config, folder / "other", &observer), InputError);
  EXPECT_FALSE(fs::exists(folder / "other"));
}

// What the refusal says to do is done at the end.
TEST(CemRun, NetworksThatHaveNotLearntThePriorSetAreRefusedOrTrainedOn) {
  const TempFolder folder;
  StoppingObserver observer;
  TrainPrior(folder / "prior");  // of cylinders
  const std::string mine = (folder / "mine.h5").string();
  ShapeSet set = MakePriorSet({.kind = "prisms", .count = 8});
  const std::string with_kind = (folder / "prisms.h5").string();
  WriteShapeSet(with_kind, set);
  set.kind = "meshes";
  WriteShapeSet(mine, set);
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  config.start = (folder / "prior").string();
  const auto refusal = [&](const RunConfig& refused) -> std::string {
    try {
      StartRun(refused, folder / "run", &observer);
    } catch (const InputError& error) {
      EXPECT_FALSE(fs::exists(folder / "run"));
      return error.what();
    }
    return "";
  };
  const auto line = [&](const std::string& prior) {
    return "networks of another prior set than " + prior + " (run.start = " + config.start +
           "): expected --fine-tune to train them on with it first, --from-scratch for new ones, " +
           "or --set prior.kind=cylinders, which they have learnt";
  };
  config.prior_file = mine;
  EXPECT_EQ(refusal(config), line("prior.file=" + mine));
  config.prior_file = with_kind;
  EXPECT_EQ(refusal(config), line("prior.file=" + with_kind));
  config.prior_file.clear();
  config.prior.kind = "prisms";
  EXPECT_EQ(refusal(config), line("prior.kind=prisms"));

  config.prior_file = mine;
  config.fine_tune = true;
  StartRun(config, folder / "tuned", &observer);
  // Those have learnt that file, and neither cylinders nor prisms.
  config.fine_tune = false;
  config.start = (folder / "tuned").string();
  StartRun(config, folder / "again", &observer);
  config.prior_file = with_kind;
  EXPECT_TRUE(
      refusal(config).ends_with("or --set prior.file=" + mine + ", which they have learnt"));
}

// Another number of cylinders, or a file of them, is the same kind of set.
TEST(CemRun, NetworksOfTheSameKindOfSetAreBegunWith) {
  const TempFolder folder;
  StoppingObserver observer;
  TrainPrior(folder / "prior");
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  config.start = (folder / "prior").string();
  config.prior.count = 6;
  config.prior.seed = 5;
  StartRun(config, folder / "fewer", &observer);
  config.prior_file = (folder / "cylinders.h5").string();
  WriteShapeSet(config.prior_file, MakePriorSet({.count = 6, .seed = 7}));
  StartRun(config, folder / "file", &observer);
}

TEST(CemRun, TrainsGivenNetworksOnWhereFineTuningIsAskedFor) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult prior = TrainPrior(folder / "prior");
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  config.start = (folder / "prior").string();
  config.fine_tune = true;
  config.cem.prior_iterations = 10;
  const RunResult tuned = StartRun(config, folder / "tuned", &observer);
  EXPECT_NE(tuned.stages[1].graspability.mean, prior.stages[1].graspability.mean);
  const std::string losses = ReadFile(folder / "tuned" / "episode_0" / "losses.csv");
  EXPECT_NE(losses, ReadFile(folder / "prior" / "episode_0" / "losses.csv"));
  EXPECT_NE(losses.find("\n10,"), std::string::npos) << losses;

  config.start.clear();
  EXPECT_THROW(StartRun(config, folder / "other", &observer), InputError);
  EXPECT_FALSE(fs::exists(folder / "other"));
}

}  // namespace
}  // namespace antigrasp
