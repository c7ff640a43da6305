#include <cstdio>
#include <memory>
#include <string>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/trial_flags.h"
#include "antigrasp/core/error.h"
#include "antigrasp/judge/model_trials.h"

namespace antigrasp {
namespace {

constexpr const char* kBoth = "both";

enum class TrialEngine { kMujoco, kModel };
constexpr auto ChoicesOf(TrialEngine) {
  return std::to_array<Choice<TrialEngine>>(
      {{TrialEngine::kMujoco, "mujoco"}, {TrialEngine::kModel, "model"}});
}

struct TrialFlags : PhysicsTrialRequest {
  TrialEngine engine = TrialEngine::kMujoco;
  ProtocolName protocol = ProtocolName::kSixWays;
  double friction_angle = 17.0;
  std::string reading = kBoth;  // or a FrictionReading
  bool millimetres = false;
  int processes = 1;
};

void RequireNoPhysics(const CLI::App& command, const TypedTrial& typed) {
  for (const char* flag :
       {"--baseline", "--friction", "--protocol", "--equal-mass", "--replays", "--overwrite"}) {
    if (command.count(flag) == 0) continue;
    throw InputError("the model has no such thing", flag, "--engine mujoco");
  }
  RequireModelOptions(typed);
}

void Trial(TrialFlags flags, const CLI::App& command, const TypedTrial& typed,
           const MetricFlags& metric_flags) {
  const Protocol protocol = ProtocolOf(flags.protocol);
  MetricOptions metric = metric_flags.Resolve();
  const PhysicsTrialOptions options = TrialOptionsOf(protocol, typed, &metric);
  if (flags.millimetres) {
    metric.object_min_extent = 0.0;
    metric.units = LengthUnit::kMm;
  }
  if (flags.engine == TrialEngine::kModel) {
    RequireNoPhysics(command, typed);
    if (Helps(flags.share)) return;  // rank 0 alone
    ConsoleObserver console;
    const std::string text = TryByModel(flags, metric, options.series, flags.friction_angle,
                                        flags.reading, &console, &Warn);
    std::fputs(text.c_str(), stdout);
    return;
  }
  RequireOptionsUsed(protocol, options.physics.tip.shape, typed);
  if (command.count("--equal-mass") > 0 && (flags.baseline.empty() || options.mass > 0.0)) {
    throw InputError("nothing is compared", "--equal-mass",
                     "--baseline, and no other mass (--mass, or of the protocol)");
  }
  const bool by_angle = command.count("--friction-angle") + command.count("--reading") > 0;
  flags.frictions =
      by_angle ? FrictionsOf(FindChoice<FrictionReading>(flags.reading), flags.friction_angle)
               : std::vector<double>{metric.friction};
  ConsoleObserver console;
  const PhysicsTrialReport report = TryInPhysics(flags, metric, options, &console);
  if (Helps(flags.share)) return;
  for (const std::string& warning : report.warnings) Warn(warning);
  std::fputs(report.text.c_str(), stdout);
  if (report.interrupted) throw Interrupted();
}

}  // namespace

void AddTrialCommand(CLI::App* app, const JobRunner& job) {
  const auto flags = std::make_shared<TrialFlags>();
  CLI::App* command = app->add_subcommand(
      "trial", "Try in physics how often a gripper holds objects (the paper's Table I)");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  AddChoice(command, "--engine", &flags->engine, "mujoco: physics; model: the metric's contacts");
  AddChoice(command, "--protocol", &flags->protocol, "how grasps are tried, below");
  command->add_option("--baseline", flags->baseline,
                      "the same objects before a change (paired by name): both are tried");
  command->add_option(
      "--out", flags->out,
      "folder for trials.csv, means.csv, executions.csv and replays.json; with the model a "
      "table (CSV), the constants go to the same name plus .trial.toml");
  AddOverwrite(command, &flags->overwrite);
  command->add_option("--equal-mass", flags->equal_mass, "kg, of both sides of a comparison")
      ->check(NumberIn(1e-4, 1e3))
      ->capture_default_str();
  command->add_option("--replays", flags->replays, "of an object, held and lost ones each")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--friction-angle", flags->friction_angle,
                   "degrees, in place of --friction; the model always takes it")
      ->check(NumberIn(0.0, 80.0))
      ->capture_default_str();
  std::vector<std::string> readings = ChoiceNames<FrictionReading>();
  readings.emplace_back(kBoth);
  command->add_option("--reading", flags->reading, Alternatives(readings))
      ->check(CLI::IsMember(readings))
      ->capture_default_str();
  CLI::Option* mm = command->add_flag("--mm", flags->millimetres, "--units mm --true-size");
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->threads, "; results do not depend on it");
  AddProcesses(command, &flags->processes);
  const auto trial_flags = AddTrialFlags(command);
  const auto metric_flags = std::make_shared<MetricFlags>(command);
  command->remove_option(command->get_option("--percentile"));  // without meaning here
  command->get_option("--friction")->excludes("--friction-angle", "--reading");
  for (const char* name : {"--units", "--object-min-extent"}) mm->excludes(name);
  command->footer(kTrialHelp);
  command->callback([flags, command, trial_flags, metric_flags, job] {
    job(flags->processes, [&](WorkShare* share) {
      flags->share = share;
      Trial(*flags, *command, TypedOf(*command, *trial_flags), *metric_flags);
    });
  });
}

}  // namespace antigrasp
