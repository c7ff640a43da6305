// Figure 4: what a run sampled at every stage.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/report/figure_inputs.h"
#include "antigrasp/report/figures/histogram.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/run_record.h"
#include "antigrasp/train/stage_samples.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// The first samples of a stage that are usable objects, as the run numbers them.
std::vector<std::int64_t> FirstUsable(const std::vector<double>& graspabilities, int count) {
  std::vector<std::int64_t> indices;
  for (std::size_t i = 0; i < graspabilities.size() && std::ssize(indices) < count; ++i) {
    if (std::isfinite(graspabilities[i])) indices.push_back(static_cast<std::int64_t>(i));
  }
  return indices;
}

std::vector<FigureExample> Examples(const RunFolder& run, const RunConfig& config, int episode,
                                    const std::vector<double>& graspabilities, int count,
                                    const ShapeModelMaker& make, RunObserver* observer) {
  const fs::path source = episode < 0 ? run.Prior() : run.EpisodeCheckpoint(episode);
  const std::vector<std::int64_t> indices = FirstUsable(graspabilities, count);
  std::vector<FigureExample> examples(indices.size());
  if (indices.empty() || !fs::exists(source)) return {};
  const torch::Tensor values = StageValues(run, config, episode, indices,
                                           observer->Phase(StageName(episode, "sampling")), make);
  ParallelFor(std::ssize(indices), config.threads, [&](std::int64_t j) {
    const auto slot = static_cast<std::size_t>(j);
    examples[slot].mesh = Remesh(GridOf(values[j], config.model)).mesh;
    char text[32];
    std::snprintf(text, sizeof text, "g = %.5f",
                  graspabilities[static_cast<std::size_t>(indices[slot])]);
    examples[slot].caption = text;
  });
  return examples;
}

}  // namespace

RowFigure RunFigure(const fs::path& folder, std::vector<int> episodes, int examples, int threads,
                    RunObserver* observer, const ShapeModelMaker& make) {
  RequireFile(RunFolder{folder}.Config(), "the config.toml of a run");
  const RunRecord run = ReadRun(folder);
  RunConfig config = *run.config;
  config.threads = threads;
  const std::vector<double> first = GraspabilitiesOf(run.Find(0));
  const std::vector<double> prior = GraspabilitiesOf(run.Find(-1));
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
  if (episodes.empty()) {
    for (int episode = 0; episode <= config.cem.episodes; ++episode) episodes.push_back(episode);
  }
  episodes.insert(episodes.begin(), -1);
  for (const int episode : episodes) {
    const std::vector<double> graspabilities = GraspabilitiesOf(run.Find(episode));
    FigureRow row;
    row.label = StageName(episode);
    row.label[0] = static_cast<char>(std::toupper(row.label[0]));
    row.gap = "not scored";
    row.values = Divided(graspabilities, mean);
    row.reference = Divided(by_first ? first : prior, mean);
    row.examples = Examples(run.folder, config, episode, graspabilities, examples, make, observer);
    figure.rows.push_back(std::move(row));
  }
  return figure;
}

}  // namespace antigrasp
