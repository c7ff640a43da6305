#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/scored_objects.h"
#include "antigrasp/core/atomic_file.h"

namespace antigrasp {
namespace {

struct EvaluateFlags {
  std::vector<std::string> inputs;
  std::vector<std::string> baseline;
  std::string out;
  std::string grasps;
  std::uint64_t seed = 1;
  int threads = 0;
};

std::vector<double> Values(const std::vector<ScoredObject>& scored) {
  std::vector<double> values;
  for (const ScoredObject& item : scored) values.push_back(item.Value());
  return values;
}

void WriteScores(const EvaluateFlags& flags, const MetricOptions& metric, const std::string& csv) {
  if (flags.out.empty()) {
    std::printf("%s", csv.c_str());
    return;
  }
  WriteFileAtomic(flags.out, csv);
  WriteFileAtomic(flags.out + ".metric.toml", MetricToml(metric, flags.seed));
}

// " +-0.00012 (95 %)"; nothing for a single object, which says nothing about the spread.
std::string HalfWidth(const char* format, double half_width) {
  char text[64] = "";
  if (std::isfinite(half_width)) std::snprintf(text, sizeof text, format, half_width);
  return text;
}

void PrintSummary(const std::vector<ScoredObject>& scored) {
  const MeanInterval mean = MeanWithInterval(Values(scored));
  std::fprintf(stderr, "%d objects scored, %d not: mean graspability %.5f%s\n", mean.count,
               static_cast<int>(scored.size()) - mean.count, mean.mean,
               HalfWidth(" +-%.5f (95 %%)", mean.half_width).c_str());
  std::fprintf(stderr, "%s\n", AcceptanceLine(scored).c_str());
}

// Of the pairs that both have a score.
void PrintPairedDifference(const std::vector<ScoredObject>& scored,
                           const std::vector<ScoredObject>& baselines) {
  const std::vector<double> changed = Values(scored), original = Values(baselines);
  std::vector<double> difference, of_pairs;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    difference.push_back(changed[i] - original[i]);
    of_pairs.push_back(original[i] + 0.0 * changed[i]);  // NaN where either is
  }
  const MeanInterval mean = MeanWithInterval(difference);
  const double baseline = MeanWithInterval(of_pairs).mean;
  std::fprintf(
      stderr, "paired difference %+.5f%s, %+.1f%s %% of the baseline's %.5f, %d pairs\n", mean.mean,
      HalfWidth(" +-%.5f (95 %%)", mean.half_width).c_str(), 100.0 * mean.mean / baseline,
      HalfWidth(" +-%.1f", 100.0 * mean.half_width / baseline).c_str(), baseline, mean.count);
}

void Evaluate(const EvaluateFlags& flags, const MetricFlags& metric_flags) {
  const MetricOptions metric = metric_flags.Resolve();
  for (const std::string& out : {flags.out, flags.grasps}) {
    if (!out.empty()) const AtomicFile probe(out);  // refuses an unwritable target before the work
  }
  ConsoleObserver console;
  std::vector<InputObject> objects =
      LoadObjects(flags.inputs, flags.threads, console.Phase("reading"));
  std::vector<InputObject> originals;
  if (!flags.baseline.empty()) originals = LoadBaselines(flags.baseline, objects, flags.threads);
  const std::vector<ScoredObject> scored =
      ScoreObjects(std::move(objects), metric, flags.seed, flags.threads, "scoring");
  std::vector<ScoredObject> baselines;
  if (!flags.baseline.empty()) {
    baselines = ScoreObjects(std::move(originals), metric, flags.seed, flags.threads,
                             "scoring the baseline");
  }
  for (const ScoredObject& item : scored) {
    if (!item.object.note.empty()) spdlog::warn("{}: {}", item.object.name, item.object.note);
  }
  if (!flags.grasps.empty()) WriteFileAtomic(flags.grasps, GraspsCsv(scored));
  const bool egad = metric_flags.preset() == "egad";
  const auto rows = ScoreRows(scored, egad, flags.baseline.empty() ? nullptr : &baselines);
  WriteScores(flags, metric, ScoresCsv(rows));
  PrintSummary(scored);
  if (!flags.baseline.empty()) PrintPairedDifference(scored, baselines);
}

}  // namespace

void AddEvaluateCommand(CLI::App* app) {
  const auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* command = app->add_subcommand("evaluate", "Score the graspability of objects");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out,
                      "scores (CSV); the constants go to the same name plus .metric.toml. "
                      "Without it the scores go to standard output");
  command->add_option("--grasps", flags->grasps, "every sampled grasp (CSV)");
  command->add_option("--baseline", flags->baseline,
                      "the same objects before a change (meshes, folders, SDF files; paired by "
                      "name): prints the paired difference under equal random numbers");
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all; scores do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  const auto metric = std::make_shared<MetricFlags>(command);
  command->callback([flags, metric] { Evaluate(*flags, *metric); });
}

}  // namespace antigrasp
