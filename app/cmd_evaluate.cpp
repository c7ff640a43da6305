#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/hardest.h"
#include "antigrasp/app/score_notes.h"
#include "antigrasp/app/scored_objects.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/quality/grasp_table.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

struct EvaluateFlags {
  std::vector<std::string> inputs;
  std::vector<std::string> baseline;
  std::string out;
  std::string grasps;
  GraspFrame frame = GraspFrame::kMetres;
  int hardest = 0;  // 0: all objects
  std::uint64_t seed = 1;
  int threads = 0;
};

// What is kept of the objects when they have been scored.
struct Scores {
  explicit Scores(const MetricOptions& metric) : sizes(metric) {}
  ScoreTable table;
  std::vector<ScoreRow> rows;             // in place of the table, to choose from
  std::string first;                      // the first one and its status
  std::vector<double> values, originals;  // graspabilities, NaN where there is none
  std::vector<std::string> notes;
  CandidateCount candidates;
  UnlikelySizes sizes;
  std::string interval;                // of the only score, over its grasps
  std::optional<PairDifference> pair;  // of the only pair
};

std::string MetricPath(const EvaluateFlags& flags) {
  return flags.out.empty() ? "" : flags.out + ".metric.toml";
}

void WriteScores(const EvaluateFlags& flags, const MetricOptions& metric, const std::string& csv) {
  if (flags.out.empty()) {
    std::printf("%s", csv.c_str());
    return;
  }
  WriteFileAtomic(flags.out, csv);
  WriteFileAtomic(MetricPath(flags), MetricToml(metric, flags.seed));
}

// " +-0.00012 (95 %)"; nothing for a single object, which says nothing about the spread.
std::string HalfWidth(const char* format, double half_width) {
  char text[64] = "";
  if (std::isfinite(half_width)) std::snprintf(text, sizeof text, format, half_width);
  return text;
}

void PrintSummary(const Scores& scores, const MetricOptions& metric) {
  const MeanInterval mean = MeanWithInterval(scores.values);
  std::fprintf(stderr, "%d objects scored, %d not: mean graspability %.5f%s, %s\n", mean.count,
               static_cast<int>(scores.values.size()) - mean.count, mean.mean,
               HalfWidth(" +-%.5f (95 %%)", mean.half_width).c_str(), SizeText(metric).c_str());
  std::fprintf(stderr, "%s\n", scores.candidates.Text().c_str());
}

// Of the pairs that both have a score.
void PrintPairedDifference(const Scores& scores) {
  if (scores.pair) {
    std::fprintf(stderr, "%s\n", PairText(*scores.pair, scores.originals.front()).c_str());
    return;
  }
  const std::vector<double>&changed = scores.values, &original = scores.originals;
  std::vector<double> difference, of_pairs;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    difference.push_back(changed[i] - original[i]);
    of_pairs.push_back(original[i] + 0.0 * changed[i]);  // NaN where either is
  }
  const MeanInterval mean = MeanWithInterval(difference);
  const double baseline = MeanWithInterval(of_pairs).mean;
  if (mean.count == 0) {
    std::fprintf(stderr, "no paired difference: no object and its baseline both have a score\n");
    return;
  }
  std::fprintf(stderr, "paired difference %+.5f%s", mean.mean,
               HalfWidth(" +-%.5f (95 %%)", mean.half_width).c_str());
  if (baseline > 0.0) {
    std::fprintf(stderr, ", %+.1f%s %% of the baseline's %.5f", 100.0 * mean.mean / baseline,
                 HalfWidth(" +-%.1f", 100.0 * mean.half_width / baseline).c_str(), baseline);
  }
  std::fprintf(stderr, "%s, %d pairs\n", baseline > 0.0 ? "" : ", the baseline is 0", mean.count);
}

// How many grasps it took, and what the scores mean beside known ones.
void PrintNotes(const Scores& scores, const MetricOptions& metric, bool effort_given) {
  const auto objects = std::ssize(scores.values);
  if (!scores.interval.empty()) std::fprintf(stderr, "%s\n", scores.interval.c_str());
  if (!effort_given) std::fprintf(stderr, "%s\n", EffortText(objects, metric).c_str());
  const MeanInterval mean = MeanWithInterval(scores.values);
  std::fprintf(stderr, "%s\n", KnownText(mean.mean, mean.count > 1, metric).c_str());
}

// InputError, before anything is written, when no object has a score.
void RequireAScore(const EvaluateFlags& flags, const Scores& scores) {
  for (const double value : scores.values) {
    if (!std::isnan(value)) return;
  }
  throw InputError("no object scored; " + scores.first, flags.inputs.front(), "a closed solid");
}

// Of an only object: what its grasps say about how sure its numbers are.
void LookAtGrasps(const ScoredObject& scored, const std::optional<ScoredObject>& original,
                  const MetricOptions& metric, Scores* scores) {
  if (!std::isfinite(scored.Value())) return;
  scores->interval = IntervalText(scored.score);
  if (!original || !std::isfinite(original->Value())) return;
  scores->pair = DifferenceOf(scored.score, original->score, metric.percentile);
  if (FileNameOf(scored.name) == FileNameOf(original->name)) return;
  scores->notes.push_back(scored.name + " and " + original->name +
                          " are taken as a pair, though their names differ: there is one of each");
}

// Object by object, each with its original's graspability where there are originals.
Scores ScoreAllOf(const ObjectSource& objects, const EvaluateFlags& flags,
                  const MetricOptions& metric, bool egad) {
  std::optional<ObjectSource> originals;
  std::vector<std::int64_t> original_of;
  if (!flags.baseline.empty()) {
    originals.emplace(flags.baseline);
    original_of = PairWithOriginals(objects, *originals);
  }
  std::optional<AtomicFile> grasps_file;
  if (!flags.grasps.empty()) grasps_file.emplace(flags.grasps);
  GraspTable grasps(flags.frame);
  Scores scores(metric);
  ConsoleObserver console;
  StreamInOrder(
      objects.size(), flags.threads,
      [&](std::int64_t i) {
        const std::uint64_t stream = objects.stream(i);
        std::optional<ScoredObject> original;
        if (originals) {
          const std::int64_t place = original_of[static_cast<std::size_t>(i)];
          original = ScoreObject(originals->Load(place), stream, metric, flags.seed);
        }
        return std::pair(ScoreObject(objects.Load(i), stream, metric, flags.seed), original);
      },
      [&](std::int64_t, const std::pair<ScoredObject, std::optional<ScoredObject>>& item) {
        const auto& [scored, original] = item;
        if (scores.first.empty()) scores.first = scored.name + ": " + scored.status;
        const double baseline = original ? original->Value() : 0.0;
        const ScoreRow row = RowOf(scored, egad, original ? &baseline : nullptr);
        if (flags.hardest > 0) {
          scores.rows.push_back(row);
        } else {
          scores.table.Add(row);
        }
        scores.values.push_back(scored.Value());
        if (original) scores.originals.push_back(baseline);
        if (objects.size() == 1) LookAtGrasps(scored, original, metric, &scores);
        if (!scored.note.empty()) scores.notes.push_back(scored.name + ": " + scored.note);
        scores.candidates.Add(scored.score);
        scores.sizes.Add(scored.name, scored.extent, &scored.score);
        if (!grasps_file) return;
        grasps.Add(scored.name, scored.score, scored.center_of_mass);
        grasps_file->Append(grasps.TakeText());
      },
      console.Phase("scoring"));
  const std::string shared = SharedDrawsText(objects);
  if (!shared.empty()) scores.notes.push_back(shared);
  for (const std::string& note : scores.notes) spdlog::warn("{}", note);
  for (const std::string& size : scores.sizes.Texts()) spdlog::warn("{}", size);
  RequireAScore(flags, scores);
  if (grasps_file) grasps_file->Commit();
  return scores;
}

void Evaluate(const EvaluateFlags& flags, const MetricFlags& metric_flags) {
  MetricOptions metric = metric_flags.Resolve();
  for (const std::string& out : {flags.out, flags.grasps}) {
    if (!out.empty()) const AtomicFile probe(out);  // refuses an unwritable target before the work
  }
  RequireApart({flags.out, MetricPath(flags), flags.grasps});
  const ObjectSource objects(flags.inputs);
  objects.RequireNotRead({flags.out, MetricPath(flags), flags.grasps});
  RequireNotRead(metric_flags.gripper(), {flags.out, MetricPath(flags), flags.grasps});
  if (!flags.baseline.empty()) {
    ObjectSource(flags.baseline).RequireNotRead({flags.out, MetricPath(flags), flags.grasps});
  }
  metric_flags.RaiseEffort(objects.size(), &metric);
  const Scores scores = ScoreAllOf(objects, flags, metric, metric_flags.preset() == "egad");
  std::vector<HardestObject> hardest;
  if (flags.hardest > 0) {
    ConsoleObserver console;
    hardest = FindHardest(objects, scores.rows, flags.hardest, metric, flags.seed, flags.threads,
                          &console);
  }
  ScoreTable of_hardest;
  for (const HardestObject& found : hardest) of_hardest.Add(found.row);
  WriteScores(flags, metric, (hardest.empty() ? scores.table : of_hardest).Csv());
  PrintSummary(scores, metric);
  PrintNotes(scores, metric, metric_flags.effort_given());
  if (!hardest.empty()) {
    std::fprintf(stderr, "%s\n", HardestText(hardest, objects.size()).c_str());
  }
  if (!flags.baseline.empty()) PrintPairedDifference(scores);
}

}  // namespace

void AddEvaluateCommand(CLI::App* app) {
  const auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* command = app->add_subcommand("evaluate", "Score the graspability of objects");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out,
                      "scores (CSV); the constants go to the same name plus .metric.toml. "
                      "Without it the scores go to standard output");
  CLI::Option* grasps = command->add_option("--grasps", flags->grasps, "every sampled grasp (CSV)");
  AddChoice(
      command, "--frame", &flags->frame,
      "of --grasps: metres, as the metric rescales the object, or mesh, the unit and frame of "
      "the input");
  command->get_option("--frame")->needs(grasps);
  command->add_option("--baseline", flags->baseline,
                      "the same objects before a change (meshes, folders, SDF files; paired by "
                      "name): prints the paired difference under equal random numbers");
  AddHardestFlag(command, &flags->hardest,
                 "write only the N objects with the lowest graspability, scored again with fresh "
                 "draws: the lowest of many noisy scores is too low")
      ->excludes("--baseline", "--grasps");
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all; scores do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  const auto metric = std::make_shared<MetricFlags>(command);
  command->callback([flags, metric] { Evaluate(*flags, *metric); });
}

}  // namespace antigrasp
