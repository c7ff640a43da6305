#include "antigrasp/train/cem_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/render/image.h"
#include "antigrasp/train/episode_loop.h"
#include "antigrasp/train/scalar_log.h"
#include "tests/support/temp_folder.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::StoppingObserver;
using shapes::TempFolder;
using shapes::Tiny;

std::map<std::string, std::string> FilesIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    // Events of TensorBoard and the provenance hold the time of day.
    if (entry.is_regular_file() && entry.path().parent_path().filename() != "tensorboard" &&
        entry.path().filename() != "provenance.toml") {
      files[fs::relative(entry.path(), folder).string()] = ReadFile(entry.path());
    }
  }
  return files;
}

void ExpectSameFiles(const fs::path& a, const fs::path& b) {
  const auto in_a = FilesIn(a);
  const auto in_b = FilesIn(b);
  for (const auto& [name, bytes] : in_a) {
    ASSERT_TRUE(in_b.contains(name)) << name;
    EXPECT_TRUE(in_b.at(name) == bytes) << name << " differs";
  }
  EXPECT_EQ(in_a.size(), in_b.size());
}

TEST(CemRun, WritesEveryStageAndPrintableSolids) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult result = StartRun(Tiny(), folder / "run", &observer);
  ASSERT_EQ(result.stages.size(), 4U);  // prior, 0, 1, 2
  EXPECT_EQ(result.stages[0].stage, -1);
  EXPECT_EQ(result.stages[0].rejected(), 0);
  EXPECT_GT(result.stages[0].graspability.mean, 0.0);
  for (int e = 0; e < 3; ++e) {
    const RunFolder run{folder / "run"};
    EXPECT_TRUE(IsCheckpoint(run.EpisodeCheckpoint(e)));
    EXPECT_TRUE(fs::exists(run.Episode(e) / "scores.csv"));
    EXPECT_TRUE(IsShapeSet(run.Episode(e) / "elites.h5"));
    const Image samples = ReadPng(run.Episode(e) / "samples.png");
    EXPECT_EQ(samples.width, 8 * 160);
    EXPECT_GT(std::count(samples.pixels.begin(), samples.pixels.end(), Rgb{255, 255, 255}), 0);
  }
  for (const auto& entry : fs::directory_iterator(folder / "run/stl")) {
    if (entry.path().extension() != ".stl") continue;
    const TriangleMesh mesh = ReadMesh(entry.path());
    EXPECT_EQ(WhyNotSolid(Inspect(mesh)), "") << entry.path();
    EXPECT_NEAR(Bounds(mesh).Extent().maxCoeff(), 60.0, 1e-4);
  }
}

// The events of a run but for what depends on the time of day.
std::vector<std::tuple<std::string, std::int64_t, float>> Events(const fs::path& run) {
  std::vector<std::tuple<std::string, std::int64_t, float>> events;
  for (const ScalarEvent& event : ReadScalarEvents(RunFolder{run}.Events())) {
    if (event.tag == "training/updates_per_second") continue;
    events.emplace_back(event.tag, event.step, event.value);
  }
  return events;
}

TEST(CemRun, GivesEqualBytesTwiceAndAfterAnyInterruption) {
  const TempFolder folder;
  StoppingObserver never;
  StartRun(Tiny(), folder / "a", &never);
  StartRun(Tiny(), folder / "b", &never);
  ExpectSameFiles(folder / "a", folder / "b");
  int kappas = 0;
  for (const auto& [tag, step, value] : Events(folder / "a")) kappas += tag == "stage/kappa";
  EXPECT_EQ(kappas, 3);
  // In the prior's scoring, in training on and off a checkpoint, sampling, scoring, and episode 2.
  for (const int stop : {3, 17, 38, 45, 55, 85}) {
    const fs::path run = folder / ("stopped-" + std::to_string(stop));
    StoppingObserver stopping(stop + 24);  // making the prior set reports 24 times
    EXPECT_THROW(StartRun(Tiny(), run, &stopping), Interrupted) << stop;
    ResumeRun(run, &never);
    ExpectSameFiles(folder / "a", run);
    EXPECT_EQ(Events(folder / "a"), Events(run)) << stop;
  }
}

TEST(CemRun, SelectionKeepsLowerScoresThanTheControl) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.control = true;
  const RunResult result = StartRun(config, folder / "run", &observer);
  ASSERT_EQ(result.control.size(), result.stages.size());
  // Both forks begin with the same networks: the same samples, the same scores.
  EXPECT_EQ(result.control[1].graspability.mean, result.stages[1].graspability.mean);
  EXPECT_LE(result.stages[1].elite_threshold, result.control[1].elite_threshold);
}

TEST(CemRun, ReportsAFinishedRunWithoutDoingItAgain) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult first = StartRun(Tiny(), folder / "run", &observer);
  StoppingObserver strict(0);  // any progress at all would throw
  const RunResult again = ResumeRun(folder / "run", &strict);
  EXPECT_EQ(StatisticsToCsv(again.stages), StatisticsToCsv(first.stages));
}

RunConfig Latent() {
  RunConfig config = Tiny();
  config.cem.mode = "latent";
  return config;
}

TEST(CemRun, LatentModeMovesTheNoiseAndLeavesTheNetworksAlone) {
  const TempFolder folder;
  StoppingObserver observer;
  StartRun(Latent(), folder / "run", &observer);
  const RunFolder run{folder / "run"};
  const RunConfig config = ConfigOfRun(run.root);
  GanTrainer first = MakeTrainer(config), last = MakeTrainer(config);
  ReadNetworks(run.EpisodeCheckpoint(0), [&](auto* archive) { first.LoadNetworks(archive); });
  ReadNetworks(run.EpisodeCheckpoint(2), [&](auto* archive) { last.LoadNetworks(archive); });
  EXPECT_EQ(first.latent().means.abs().max().item<double>(), 0.0);
  EXPECT_GT(last.latent().means.abs().max().item<double>(), 0.1);
  EXPECT_FALSE(torch::equal(first.Sample(1, 0, 4), last.Sample(1, 0, 4)));
  last.BeginFixedEpisode(0, first.latent());
  EXPECT_TRUE(torch::equal(first.Sample(1, 0, 4), last.Sample(1, 0, 4)));
}

TEST(CemRun, LatentModeGivesEqualBytesAfterAnyInterruption) {
  const TempFolder folder;
  StoppingObserver never;
  StartRun(Latent(), folder / "a", &never);
  for (const int stop : {50, 60, 72}) {  // scoring episode 0, sampling and scoring the next
    const fs::path run = folder / ("stopped-" + std::to_string(stop));
    StoppingObserver stopping(stop + 24);
    EXPECT_THROW(StartRun(Latent(), run, &stopping), Interrupted) << stop;
    ResumeRun(run, &never);
    ExpectSameFiles(folder / "a", run);
  }
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
  const RunResult result = StartRun(config, folder / "run", &observer);
  ASSERT_EQ(result.stages.size(), 4U);
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

TEST(CemRun, TrainsGivenNetworksOnWhereFineTuningIsAskedFor) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult prior = TrainPrior(folder / "prior");
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  config.start = (folder / "prior").string();
  config.fine_tune = true;
  const RunResult tuned = StartRun(config, folder / "tuned", &observer);
  EXPECT_NE(tuned.stages[1].graspability.mean, prior.stages[1].graspability.mean);
  const std::string losses = ReadFile(folder / "tuned" / "episode_0" / "losses.csv");
  EXPECT_NE(losses, ReadFile(folder / "prior" / "episode_0" / "losses.csv"));
  EXPECT_NE(losses.find("\n" + std::to_string(config.cem.prior_iterations) + ","),
            std::string::npos)
      << losses;

  config.start.clear();
  EXPECT_THROW(StartRun(config, folder / "other", &observer), InputError);
  EXPECT_FALSE(fs::exists(folder / "other"));
}

TEST(CemRun, StratifiedElitesGiveEqualBytesTwice) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.variant = "stratified";
  config.cem.cells = 6;
  config.gan.later_rate = 0.5;
  StartRun(config, folder / "a", &observer);
  StartRun(config, folder / "b", &observer);
  ExpectSameFiles(folder / "a", folder / "b");
}

TEST(RunFolder, RemovesARunAndNothingElse) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  StartRun(config, folder / "run", &observer);
  WriteFileAtomic(folder / "run/thesis.tex", "years of work");
  RunFolder{folder / "run"}.Remove();
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "run"), {}), 1);
  EXPECT_EQ(ReadFile(folder / "run/thesis.tex"), "years of work");
}

TEST(CemRun, RefusesAFolderThatHoldsARunAndADeviceThatIsNotThere) {
  const TempFolder folder;
  StoppingObserver observer;
  fs::create_directory(folder / "run");
  WriteFileAtomic(folder / "run/config.toml", "");
  EXPECT_THROW(StartRun(Tiny(), folder / "run", &observer), InputError);
  RunConfig config = Tiny();
  config.device = "toaster";
  EXPECT_THROW(StartRun(config, folder / "other", &observer), InputError);
  EXPECT_FALSE(fs::exists(folder / "other"));
  EXPECT_THROW(ResumeRun(folder / "nothing", &observer), InputError);
}

}  // namespace
}  // namespace antigrasp
