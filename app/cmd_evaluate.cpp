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
#include "antigrasp/grasp_io/grasp_files.h"
#include "antigrasp/judge/given_objects.h"
#include "antigrasp/judge/make_judge.h"
#include "antigrasp/judge/score_objects.h"
#include "antigrasp/quality/named_gripper.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

struct EvaluateFlags : GivenRequest {  // whose grasps are those of --grasps-in
  std::vector<std::string> baseline;
  ProtocolName protocol = ProtocolName::kSixWays;
  std::string judge;
  ProgramLimits limits;
  int hardest = 0;  // 0: all objects
  int processes = 1;
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

void EvaluateHardest(const EvaluateFlags& flags, const ObjectSource& objects,
                     const Scoring& scoring) {
  const HardestOfSet found = FindHardest(objects, flags.inputs.front(), flags.hardest, scoring);
  if (Helps(flags.share)) return;
  WriteScores(flags, scoring, HardestCsv(found));
  PrintLines(found.summary);
}

// With --trial the grasps wait in flags->sampled, to be written when they have been executed.
void EvaluateAll(EvaluateFlags* given, const ObjectSource& objects, const Scoring& scoring) {
  const EvaluateFlags& flags = *given;
  const bool helps = Helps(flags.share);
  std::optional<ObjectSource> originals;
  std::vector<std::int64_t> original_of;
  if (!flags.baseline.empty()) {
    originals.emplace(flags.baseline, GridUnit::kOfFiles, UnitToReadIn(scoring.metric));
    original_of = PairWithOriginals(objects, *originals);
  }
  if (flags.in_physics && !helps) GraspFiles(flags.output, objects).RequireLabels();
  GraspFiles grasps(flags.in_physics || helps ? GraspOutput{} : flags.output, objects);
  std::int64_t place = 0;
  ScoreTable table;
  const ScoredSet scores =
      ScoreObjects(objects, flags.inputs.front(), originals ? &*originals : nullptr, original_of,
                   scoring, [&](const ScoredObject& scored, const ScoreRow& row) {
                     table.Add(row);
                     grasps.Add(place++, scored);
                     if (flags.in_physics) AddGiven(scored, &given->sampled);
                   });
  if (helps) return;
  const std::string pair = originals ? OtherNamesText(objects, *originals) : "";
  if (!pair.empty()) Warn(pair);
  for (const std::string& note : grasps.Commit()) Warn(note);
  WriteScores(flags, scoring, table.Csv());
  PrintLines(scores.Summary(scoring.effort_given));
  if (originals) PrintLines({scores.PairedDifference()});
  RequireAVerdict(scores, scoring.judge);
}

PhysicsTrialOptions TrialOf(const EvaluateFlags& flags, const TypedTrial& typed,
                            MetricOptions* metric) {
  const Protocol protocol = ProtocolOf(flags.protocol);
  const PhysicsTrialOptions trial = TrialOptionsOf(protocol, typed, metric);
  if (flags.in_physics) RequireOptionsUsed(protocol, trial.physics.tip.shape, typed, true);
  return trial;
}

void EvaluateGrasps(EvaluateFlags flags, const TypedTrial& typed, const MetricOptions& metric) {
  const std::vector<std::filesystem::path> written = {
      flags.out, MetricPath(flags), flags.out.empty() ? "" : flags.out + ".trial.toml",
      flags.output.path};
  RequireApart(written);
  ObjectSource(flags.inputs).RequireNotRead(written);
  RequireNotRead(flags.grasps, written);
  MetricOptions of_trial = metric;
  const PhysicsTrialOptions trial = TrialOf(flags, typed, &of_trial);
  flags.output.about.density = trial.density;
  if (flags.in_physics) flags.output.about.protocol = ChoiceName(flags.protocol);
  ConsoleObserver console;
  const GivenReport report = ScoreGiven(flags, metric, of_trial, trial, &console);
  if (Helps(flags.share)) return;
  std::fputs(report.table.c_str(), stdout);
  for (const std::string& warning : report.warnings) Warn(warning);
  PrintLines(report.summary);
}

void Evaluate(EvaluateFlags flags, const TypedTrial& typed, const MetricFlags& metric_flags) {
  if (!typed.First().empty() && !flags.in_physics && flags.judge.empty()) {
    throw InputError("an option of a trial", typed.First(),
                     "--trial PROTOCOL beside them, or --judge trial");
  }
  if (!flags.out.empty() && !Helps(flags.share)) {
    const AtomicFile probe(flags.out);  // refuses it before the work
  }
  ConsoleObserver console;
  Scoring scoring{metric_flags.Resolve(), metric_flags.effort_given(),
                  metric_flags.preset() == "egad", flags.seed, flags.threads};
  scoring.observer = &console;
  scoring.warn = &Warn;
  scoring.share = flags.share;
  flags.output.about.metric = scoring.metric;
  const std::string& gripper = metric_flags.gripper();
  flags.output.about.base = BaseOf(gripper.empty() ? "yumi" : gripper);
  if (!flags.grasps.empty()) return EvaluateGrasps(flags, typed, scoring.metric);
  if (flags.in_physics && flags.output.path.empty()) {
    throw InputError("--trial", "evaluate", "--grasps FILE for what it says, or --grasps-in");
  }
  if (auto metric = scoring.metric; flags.in_physics) TrialOf(flags, typed, &metric);
  const std::vector<std::filesystem::path> written = {flags.out, MetricPath(flags),
                                                      flags.output.path};
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
    EvaluateAll(&flags, objects, scoring);
    if (flags.in_physics) EvaluateGrasps(flags, typed, scoring.metric);
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

void AddEvaluateCommand(CLI::App* app, const JobRunner& job) {
  const auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* command = app->add_subcommand("evaluate", "Score the graspability of objects");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out,
                      "scores (CSV); the constants go to the same name plus .metric.toml. "
                      "Without it the scores go to standard output");
  CLI::Option* grasps =
      command->add_option("--grasps", flags->output.path,
                          "every grasp: CSV, or by extension or --grasp-format a file that other "
                          "programs read (docs/grasps.md); with --grasps-in those, labelled");
  AddChoice(command, "--grasp-format", &flags->output.format,
            "of --grasps; auto: isaac .yaml, graspgen .json, acronym .h5, dexnet .hdf5, else csv");
  command
      ->add_option("--success-quality", flags->output.about.success_quality,
                   "robust quality of a grasp that --grasps calls a success, where none was tried")
      ->check(NumberIn(0.0, 1e9))
      ->capture_default_str();
  AddChoice(
      command, "--frame", &flags->output.frame,
      "of --grasps (CSV): metres, as the metric rescales the object, or mesh, the unit and frame "
      "of the input");
  for (const char* name : {"--frame", "--grasp-format", "--success-quality"}) {
    command->get_option(name)->needs(grasps);
  }
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
      "the mesh; or what --grasps wrote, or a file or folder of another format of its "
      "(docs/grasps.md)");
  for (const char* other : {"--baseline", "--hardest"}) given->excludes(other);
  AddChoice(command, "--trial", &flags->protocol,
            "execute these, or those of --grasps, in physics, by this protocol of antigrasp trial");
  command->get_option("--trial")->excludes("--hardest");
  AddJudgeFlags(command, flags.get());
  command->get_option("--judge")->excludes(given);
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->threads, "; scores do not depend on it");
  AddProcesses(command, &flags->processes);
  const auto trial = AddTrialFlags(command);
  const auto metric = std::make_shared<MetricFlags>(command);
  command->footer(EffortRule());
  command->callback([flags, command, trial, metric, job] {
    flags->in_physics = command->count("--trial") > 0;
    job(flags->processes, [&](WorkShare* share) {
      flags->share = share;
      Evaluate(*flags, TypedOf(*command, *trial), *metric);
    });
  });
}

}  // namespace antigrasp
