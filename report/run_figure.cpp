// Figure 4: what a run sampled at every stage.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/error.h"
#include "antigrasp/quality/score_table.h"
#include "antigrasp/report/figure_inputs.h"
#include "antigrasp/report/figures/histogram.h"
#include "antigrasp/train/cem_run.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/stage_samples.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct Stage {
  int episode = -1;                    // -1: the prior set
  std::vector<double> graspabilities;  // by sample, NaN for a rejected one; empty: not there
};

fs::path ScoresOf(const RunFolder& run, int episode) {
  return episode < 0 ? run.PriorScores() : run.Episode(episode) / "scores.csv";
}

// Nothing for a stage that has not been scored.
std::vector<double> ReadGraspabilities(const fs::path& path) {
  std::vector<double> values;
  if (!fs::exists(path)) return values;
  for (const ScoreRow& row : ReadScores(path)) {
    values.push_back(row.score ? row.score->graspability : std::nan(""));
  }
  return values;
}

std::vector<Stage> ReadStages(const RunFolder& run, const RunConfig& config,
                              std::vector<int> episodes) {
  if (episodes.empty()) {
    for (int episode = 0; episode <= config.cem.episodes; ++episode) episodes.push_back(episode);
  }
  episodes.insert(episodes.begin(), -1);
  std::vector<Stage> stages;
  for (const int episode : episodes) {
    stages.push_back({episode, ReadGraspabilities(ScoresOf(run, episode))});
  }
  return stages;
}

// The first samples of a stage that are usable objects, as the run numbers them.
std::vector<std::int64_t> FirstUsable(const std::vector<double>& graspabilities, int count) {
  std::vector<std::int64_t> indices;
  for (std::size_t i = 0; i < graspabilities.size() && std::ssize(indices) < count; ++i) {
    if (std::isfinite(graspabilities[i])) indices.push_back(static_cast<std::int64_t>(i));
  }
  return indices;
}

std::vector<FigureExample> Examples(const RunFolder& run, const RunConfig& config,
                                    const Stage& stage, int count, RunObserver* observer) {
  const fs::path source = stage.episode < 0 ? run.Prior() : run.EpisodeCheckpoint(stage.episode);
  const std::vector<std::int64_t> indices = FirstUsable(stage.graspabilities, count);
  std::vector<FigureExample> examples(indices.size());
  if (indices.empty() || !fs::exists(source)) return {};
  const torch::Tensor values =
      StageValues(run, config, stage.episode, indices,
                  observer->Phase(StageName(stage.episode) + ": sampling"));
  ParallelFor(std::ssize(indices), config.threads, [&](std::int64_t j) {
    const auto slot = static_cast<std::size_t>(j);
    examples[slot].mesh = Remesh(GridOf(values[j], config.model)).mesh;
    char text[32];
    std::snprintf(text, sizeof text, "g = %.5f",
                  stage.graspabilities[static_cast<std::size_t>(indices[slot])]);
    examples[slot].caption = text;
  });
  return examples;
}

}  // namespace

RowFigure RunFigure(const fs::path& folder, const std::vector<int>& episodes, int examples,
                    int threads, RunObserver* observer) {
  const RunFolder run{folder};
  RunConfig config = ConfigOfRun(folder);
  config.threads = threads;
  const std::vector<double> first = ReadGraspabilities(ScoresOf(run, 0));
  const std::vector<double> prior = ReadGraspabilities(ScoresOf(run, -1));
  const double of_first = MeanWithInterval(first).mean;
  const bool by_first = std::isfinite(of_first);
  const double mean = by_first ? of_first : MeanWithInterval(prior).mean;
  if (!std::isfinite(mean)) {
    throw InputError("no stage has been scored", folder.string(),
                     "a run that has come as far as its prior set");
  }
  RowFigure figure;
  figure.values_name = "stage";
  figure.reference_name = by_first ? "episode 0" : "prior set";
  figure.axis = "graspability / mean of " + std::string(by_first ? "episode 0" : "the prior set");
  for (const Stage& stage : ReadStages(run, config, episodes)) {
    FigureRow row;
    row.label = StageName(stage.episode);
    row.label[0] = static_cast<char>(std::toupper(row.label[0]));
    row.gap = "not scored";
    row.values = Divided(stage.graspabilities, mean);
    row.reference = Divided(by_first ? first : prior, mean);
    row.examples = Examples(run, config, stage, examples, observer);
    figure.rows.push_back(std::move(row));
  }
  return figure;
}

}  // namespace antigrasp
