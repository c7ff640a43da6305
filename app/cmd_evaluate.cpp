#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/trial_flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/judge/given_objects.h"
#include "antigrasp/judge/make_judge.h"
#include "antigrasp/judge/score_objects.h"
#include "antigrasp/quality/grasp_table.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

struct EvaluateFlags : GivenRequest {  // whose grasps are those of --grasps-in
  std::vector<std::string> baseline;
  std::string grasps_out;
  GraspFrame frame = GraspFrame::kMetres;
  ProtocolName protocol = ProtocolName::kSixWays;
  std::string judge;
  ProgramLimits limits;
  int hardest = 0;  // 0: all objects
};

std::string MetricPath(const EvaluateFlags& flags) {
  return flags.out.empty() ? "" : flags.out + ".metric.toml";
}

void WriteScores(const EvaluateFlags& flags, const Scoring& scoring, const std::string& csv) {
  if (flags.out.empty()) {
    std::printf("%s", csv.c_str());
    return;
  }
  WriteFileAtomic(flags.out, csv);
  WriteFileAtomic(MetricPath(flags), MetricToml(scoring.metric, flags.seed) +
                                         (scoring.judge ? scoring.judge->Toml() : ""));
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
  WriteScores(flags, scoring, HardestCsv(found));
  PrintLines(found.summary);
}

void EvaluateAll(const EvaluateFlags& flags, const ObjectSource& objects, const Scoring& scoring) {
  std::optional<ObjectSource> originals;
  std::vector<std::int64_t> original_of;
  if (!flags.baseline.empty()) {
    originals.emplace(flags.baseline, GridUnit::kOfFiles, UnitToReadIn(scoring.metric));
    original_of = PairWithOriginals(objects, *originals);
  }
  std::optional<AtomicFile> grasps_file;
  if (!flags.grasps_out.empty()) grasps_file.emplace(flags.grasps_out);
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
  WriteScores(flags, scoring, table.Csv());
  PrintLines(scores.Summary(scoring.effort_given));
  if (originals) PrintLines({scores.PairedDifference()});
  RequireAVerdict(scores, scoring.judge);
}

void EvaluateGrasps(const EvaluateFlags& flags, const TypedTrial& typed,
                    const MetricOptions& metric) {
  const std::vector<std::filesystem::path> written = {
      flags.out, MetricPath(flags), flags.out.empty() ? "" : flags.out + ".trial.toml"};
  ObjectSource(flags.inputs).RequireNotRead(written);
  RequireNotRead(flags.grasps, written);
  const Protocol protocol = ProtocolOf(flags.protocol);
  MetricOptions of_trial = metric;
  const PhysicsTrialOptions trial = TrialOptionsOf(protocol, typed, &of_trial);
  if (flags.in_physics) RequireOptionsUsed(protocol, trial.physics.tip.shape, typed, true);
  ConsoleObserver console;
  const GivenReport report = ScoreGiven(flags, metric, of_trial, trial, &console);
  std::fputs(report.table.c_str(), stdout);
  for (const std::string& warning : report.warnings) Warn(warning);
  PrintLines(report.summary);
}

void Evaluate(const EvaluateFlags& flags, const TypedTrial& typed,
              const MetricFlags& metric_flags) {
  if (!typed.First().empty() && !flags.in_physics && flags.judge.empty()) {
    throw InputError("an option of a trial", typed.First(),
                     "--trial PROTOCOL beside them, or --judge trial");
  }
  for (const std::string& out : {flags.out, flags.grasps_out}) {
    if (!out.empty()) const AtomicFile probe(out);  // refuses an unwritable target before the work
  }
  ConsoleObserver console;
  Scoring scoring{metric_flags.Resolve(), metric_flags.effort_given(),
                  metric_flags.preset() == "egad", flags.seed, flags.threads};
  scoring.observer = &console;
  scoring.warn = &Warn;
  if (!flags.grasps.empty()) return EvaluateGrasps(flags, typed, scoring.metric);
  const std::vector<std::filesystem::path> written = {flags.out, MetricPath(flags),
                                                      flags.grasps_out};
  RequireApart(written);
  const ObjectSource objects(flags.inputs, GridUnit::kOfFiles, UnitToReadIn(scoring.metric));
  objects.RequireNotRead(written);
  RequireNotRead(metric_flags.gripper(), written);
  if (!flags.baseline.empty()) ObjectSource(flags.baseline).RequireNotRead(written);
  metric_flags.RaiseEffort(objects.size(), &scoring.metric);
  std::unique_ptr<Judge> judge;
  if (!flags.judge.empty()) {
    judge = MakeJudge(flags.judge, {scoring.metric, AtEqualMass(), flags.limits, flags.seed,
                                    flags.threads, &ThrowIfInterrupted, typed});
    scoring.judge = judge.get();
  }
  if (flags.hardest > 0) {
    EvaluateHardest(flags, objects, scoring);
  } else {
    EvaluateAll(flags, objects, scoring);
  }
}

void AddJudgeFlags(CLI::App* command, EvaluateFlags* flags) {
  CLI::Option* judge =
      command->add_option("--judge", flags->judge,
                          std::string("who scores every object, too: ") + kJudges +
                              " (docs/judges.md); columns judge and judge_status of the scores");
  judge->excludes("--hardest")->check(&NoJudge);
  command
      ->add_option("--judge-limit", flags->limits.seconds,
                   "of a program: seconds without an answer, then an object is late")
      ->check(NumberIn(0.01, 1e6))
      ->capture_default_str()
      ->needs(judge);
  command
      ->add_option("--judge-restarts", flags->limits.restarts,
                   "how often a program that dies or hangs is started again")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str()
      ->needs(judge);
}

}  // namespace

void AddEvaluateCommand(CLI::App* app) {
  const auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* command = app->add_subcommand("evaluate", "Score the graspability of objects");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out,
                      "scores (CSV); the constants go to the same name plus .metric.toml. "
                      "Without it the scores go to standard output");
  CLI::Option* grasps =
      command->add_option("--grasps", flags->grasps_out, "every sampled grasp (CSV)");
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
  CLI::Option* given = command->add_option(
      "--grasps-in", flags->grasps,
      "score these grasps, not sampled ones (CSV): center_x ... axis_z, "
      "approach_* and width if there are such columns, in the unit and frame of "
      "the mesh; or what --grasps wrote (docs/grasps.md)");
  for (const char* other : {"--grasps", "--baseline", "--hardest"}) given->excludes(other);
  AddChoice(command, "--trial", &flags->protocol,
            "execute each of them in physics, by this protocol of antigrasp trial");
  command->get_option("--trial")->needs(given);
  AddJudgeFlags(command, flags.get());
  command->get_option("--judge")->excludes(given);
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->threads, "; scores do not depend on it");
  const auto trial = AddTrialFlags(command);
  const auto metric = std::make_shared<MetricFlags>(command);
  command->footer(EffortRule());
  command->callback([flags, command, trial, metric] {
    flags->in_physics = command->count("--trial") > 0;
    Evaluate(*flags, TypedOf(*command, *trial), *metric);
  });
}

}  // namespace antigrasp
