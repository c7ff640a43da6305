#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/score_objects.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/quality/grasp_table.h"
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

void PrintLines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::fprintf(stderr, "%s\n", line.c_str());
}

// A pair need not have one name when there is one of each.
void WarnOfOtherName(const ObjectSource& objects, const ObjectSource& originals) {
  if (objects.size() > 1) return;
  const std::string &object = objects.name(0), &original = originals.name(0);
  if (FileNameOf(object) == FileNameOf(original)) return;
  spdlog::warn("{} and {} are taken as a pair, though their names differ: there is one of each",
               object, original);
}

void EvaluateHardest(const EvaluateFlags& flags, const ObjectSource& objects,
                     const Scoring& scoring) {
  const HardestOfSet found = FindHardest(objects, flags.inputs.front(), flags.hardest, scoring);
  WriteScores(flags, scoring.metric, HardestCsv(found));
  PrintLines(found.summary);
}

void EvaluateAll(const EvaluateFlags& flags, const ObjectSource& objects, const Scoring& scoring) {
  std::optional<ObjectSource> originals;
  std::vector<std::int64_t> original_of;
  if (!flags.baseline.empty()) {
    originals.emplace(flags.baseline);
    original_of = PairWithOriginals(objects, *originals);
  }
  std::optional<AtomicFile> grasps_file;
  if (!flags.grasps.empty()) grasps_file.emplace(flags.grasps);
  GraspTable grasps(flags.frame);
  ScoreTable table;
  const ScoredSet scores =
      ScoreObjects(objects, flags.inputs.front(), originals ? &*originals : nullptr, original_of,
                   scoring, [&](const ScoredObject& scored, const ScoreRow& row) {
                     table.Add(row);
                     if (!grasps_file) return;
                     grasps.Add(scored.name, scored.score, scored.center_of_mass);
                     grasps_file->Append(grasps.TakeText());
                   });
  if (originals) WarnOfOtherName(objects, *originals);
  if (grasps_file) grasps_file->Commit();
  WriteScores(flags, scoring.metric, table.Csv());
  PrintLines(scores.Summary(scoring.effort_given));
  if (originals) PrintLines({scores.PairedDifference()});
}

void Evaluate(const EvaluateFlags& flags, const MetricFlags& metric_flags) {
  Scoring scoring{metric_flags.Resolve(), metric_flags.effort_given(),
                  metric_flags.preset() == "egad", flags.seed, flags.threads};
  for (const std::string& out : {flags.out, flags.grasps}) {
    if (!out.empty()) const AtomicFile probe(out);  // refuses an unwritable target before the work
  }
  const std::vector<std::filesystem::path> written = {flags.out, MetricPath(flags), flags.grasps};
  RequireApart(written);
  const ObjectSource objects(flags.inputs);
  objects.RequireNotRead(written);
  RequireNotRead(metric_flags.gripper(), written);
  if (!flags.baseline.empty()) ObjectSource(flags.baseline).RequireNotRead(written);
  metric_flags.RaiseEffort(objects.size(), &scoring.metric);
  if (flags.hardest > 0) {
    EvaluateHardest(flags, objects, scoring);
  } else {
    EvaluateAll(flags, objects, scoring);
  }
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
  AddThreads(command, &flags->threads, "; scores do not depend on it");
  const auto metric = std::make_shared<MetricFlags>(command);
  command->footer(EffortRule());
  command->callback([flags, metric] { Evaluate(*flags, *metric); });
}

}  // namespace antigrasp
