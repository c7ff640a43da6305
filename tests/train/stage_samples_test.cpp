#include "antigrasp/train/stage_samples.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/train/cem_run.h"
#include "tests/support/temp_folder.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

using shapes::StoppingObserver;
using shapes::TempFolder;

// Status and graspability of every row, as text.
std::vector<std::string> RowsOf(const std::filesystem::path& scores) {
  std::vector<std::string> rows;
  CsvReader csv(scores);
  while (csv.Next()) {
    rows.push_back(csv.Field(*csv.Column("status")) + " " + csv.Field(*csv.Column("graspability")));
  }
  return rows;
}

std::string RowOf(const RemeshResult& object, const Graspability& score) {
  if (!object.ok()) return std::string(Name(object.status)) + " ";
  return std::string(Name(score.status)) + " " + FormatDouble(score.value);
}

// Some ten seconds: two whole runs, because latent mode draws its samples another way, and every
// stage made again with one thread and with three.
TEST(StageSamples, AreThoseThatTheRunScoredInAnyOrderAndForAnyNumberOfThreads) {
  const TempFolder folder;
  StoppingObserver observer;
  for (const EpisodeMode mode : {EpisodeMode::kGan, EpisodeMode::kLatent}) {
    RunConfig config = shapes::Tiny();
    config.cem.mode = mode;
    config.cem.episodes = 1;
    config.cem.prior_scored = 0;  // all
    const RunFolder run{folder / ChoiceName(mode)};
    StartRun(config, run.root, &observer);
    for (const int stage : {-1, 0, 1}) {
      const auto rows = RowsOf(stage < 0 ? run.PriorScores() : run.Episode(stage) / "scores.csv");
      const std::vector<std::int64_t> indices = {7, 0, 3};
      for (const int threads : {1, 3}) {
        config.threads = config.torch_threads = threads;
        const auto samples = StageSamples(run, config, stage, indices, &observer);
        ASSERT_EQ(samples.objects.size(), indices.size());
        for (std::size_t j = 0; j < indices.size(); ++j) {
          EXPECT_EQ(RowOf(samples.objects[j], samples.scores[j]),
                    rows[static_cast<std::size_t>(indices[j])])
              << ChoiceName(mode) << " " << stage << " " << indices[j];
        }
      }
    }
  }
}

TEST(StageSamples, NameTheFileThatIsMissingAndTheShapeThatIsNotThere) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = shapes::Tiny();
  config.cem.episodes = 0;
  const RunFolder run{folder / "run"};
  StartRun(config, run.root, &observer);
  EXPECT_EQ(StageValues(run, config, 3, {}).size(0), 0);
  EXPECT_THROW(StageValues(run, config, -1, {8}), InputError);
  EXPECT_THROW(StageValues(run, config, 0, {-1}), InputError);
  try {
    StageValues(run, config, 3, {0});
    FAIL() << "samples of an episode that never was";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("episode_3"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace antigrasp
