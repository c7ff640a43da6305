#include "antigrasp/train/cem_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/render/image.h"
#include "antigrasp/train/scalar_log.h"
#include "antigrasp/train/statistics_table.h"
#include "tests/support/read_png.h"
#include "tests/support/temp_folder.h"
#include "tests/train/run_files.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::ExpectSameFiles;
using shapes::RunWithStops;
using shapes::StoppingObserver;
using shapes::TempFolder;
using shapes::Tiny;

TEST(CemRun, WritesEveryStageAndPrintableSolids) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunResult result = StartRun(Tiny(), folder / "run", &observer);
  ASSERT_EQ(result.stages.size(), 4U);  // prior, 0, 1, 2
  EXPECT_EQ(result.stages[0].stage, -1);
  EXPECT_EQ(result.stages[0].rejected(), 0);
  EXPECT_GT(result.stages[0].graspability.mean, 0.0);
  EXPECT_EQ(result.stages[0].samples, Tiny().cem.prior_scored);
  EXPECT_EQ(result.stages[1].samples, Tiny().cem.samples);
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

// Two runs, the second one stopped seven times: up to ten seconds, because a smaller generator
// makes no solids and a run without them ends.
TEST(CemRun, GivesEqualBytesTwiceAndAfterAnyInterruption) {
  const TempFolder folder;
  StoppingObserver never;
  const RunConfig config = Tiny();
  StartRun(config, folder / "a", &never);
  // Reports: one for each of 8 shapes made, 4 of them scored, 20 updates (4 in a later episode),
  // all samples drawn, 8 samples scored. Every update begins with the question whether to stop.
  RunWithStops(config, folder / "stopped",
               {{8 + 2, "scoring the prior set"},
                {4 + 5, "episode 0: training"},  // at update 6, off a checkpoint
                {1, "episode 0: training"},      // at update 8, on one
                {12, "episode 0: sampling"},
                {1 + 3, "episode 0: scoring"},
                {1 + 8 + 1, "episode 1: training"},
                {2 + 1 + 8 + 4 + 1 + 3, "episode 2: scoring"}});
  ExpectSameFiles(folder / "a", folder / "stopped");
  EXPECT_EQ(Events(folder / "a"), Events(folder / "stopped"));
}

TEST(CemRun, CountsUpdatesOverAllEpisodesInItsEvents) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();  // 20 updates in episode 0, then 10
  config.cem.iterations = 10;
  config.cem.episodes = 1;
  const RunResult result = StartRun(config, folder / "run", &observer);
  std::vector<std::int64_t> losses, stages;
  std::vector<float> kappas;
  for (const auto& [tag, step, value] : Events(folder / "run")) {
    if (tag == "training/loss_generator") losses.push_back(step);
    if (tag == "stage/graspability") stages.push_back(step);
    if (tag == "stage/kappa") kappas.push_back(value);
  }
  EXPECT_EQ(losses, (std::vector<std::int64_t>{10, 20, 30}));  // every tenth of an episode
  EXPECT_EQ(stages, (std::vector<std::int64_t>{20, 30}));
  ASSERT_EQ(kappas.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const double kappa =
        result.stages[i + 1].graspability.mean / result.stages[0].graspability.mean;
    EXPECT_EQ(kappas[i], static_cast<float>(kappa));
  }
}

TEST(CemRun, ReportsAFinishedRunWithoutDoingItAgain) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.episodes = 0;
  const RunResult first = StartRun(config, folder / "run", &observer);
  StoppingObserver strict(0);  // any progress at all would throw
  const RunResult again = ResumeRun(folder / "run", &strict);
  EXPECT_EQ(StatisticsToCsv(again.stages), StatisticsToCsv(first.stages));
}

RunConfig LatentRun() {
  RunConfig config = Tiny();
  config.cem.mode = EpisodeMode::kLatent;
  return config;
}

TEST(CemRun, LatentModeGivesEqualBytesAfterAnyInterruption) {
  const TempFolder folder;
  StoppingObserver never;
  StartRun(LatentRun(), folder / "a", &never);
  RunWithStops(LatentRun(), folder / "stopped",
               {{8 + 4 + 20 + 1 + 3, "episode 0: scoring"},
                {1 + 8, "episode 1: sampling"},
                {1 + 3, "episode 1: scoring"}});
  ExpectSameFiles(folder / "a", folder / "stopped");
}

TEST(CemRun, StratifiedElitesGiveEqualBytesTwice) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = Tiny();
  config.cem.variant = EliteRule::kStratified;
  config.cem.cells = 3;
  config.cem.episodes = 1;
  config.gan.later_rate = 0.5;
  StartRun(config, folder / "a", &observer);
  StartRun(config, folder / "b", &observer);
  ExpectSameFiles(folder / "a", folder / "b");
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
