#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/object_notes.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/trial/model_table.h"

namespace antigrasp {
namespace {

constexpr const char* kBoth = "both";

struct TrialFlags {
  std::vector<std::string> inputs;
  std::string out;
  double friction_angle = 17.0;
  std::string reading = kBoth;  // or a FrictionReading
  bool millimetres = false;
  std::uint64_t seed = 1;
  int threads = 0;
};

OptionFlags TrialOptionFlags(CLI::App* command) {
  TrialOptions defaults;
  OptionTable table;
  Bind(&table, &defaults);
  return {command, table, "Trial"};
}

std::vector<InputObject> LoadUsable(const TrialFlags& flags) {
  ConsoleObserver console;
  const ObjectSource source(flags.inputs);
  source.RequireNotRead({flags.out});
  std::vector<InputObject> objects = LoadObjects(source, flags.threads, console.Phase("reading"));
  WarnOfNotes(objects);
  const std::string first = objects.front().status;
  for (const InputObject& object : objects) {
    if (!object.ok()) spdlog::warn("{}: left out: {}", object.name, object.status);
  }
  std::erase_if(objects, [](const InputObject& object) { return !object.ok(); });
  if (objects.empty()) throw InputError(first, flags.inputs.front(), "a closed, oriented mesh");
  return objects;
}

std::vector<TrialReading> RunReadings(const TrialFlags& flags,
                                      const std::vector<InputObject>& objects, MetricOptions metric,
                                      const TrialOptions& options) {
  std::vector<TriangleMesh> meshes;
  std::vector<std::uint64_t> streams;
  for (const InputObject& object : objects) {
    meshes.push_back(object.mesh);
    streams.push_back(object.stream);
  }
  ConsoleObserver console;
  std::vector<TrialReading> all;
  const auto chosen = FindChoice<FrictionReading>(flags.reading);
  for (const auto [reading, name] : ChoicesOf(FrictionReading{})) {
    if (chosen && chosen != reading) continue;
    metric.friction = FrictionCoefficient(flags.friction_angle, reading);
    all.push_back({reading, metric.friction,
                   RunTrials(meshes, metric, options, flags.seed, flags.threads,
                             console.Phase("trials, " + std::string(name)), streams)});
  }
  return all;
}

std::string Constants(const TrialFlags& flags) {
  return "seed = " + std::to_string(flags.seed) +
         "\nfriction_angle = " + FormatDouble(flags.friction_angle) + "\nreading = \"" +
         flags.reading +
         "\"\n# Not used below: metric.friction, which the friction angle sets, and "
         "metric.percentile.\n\n";
}

void Trial(const TrialFlags& flags, const OptionFlags& trial_flags,
           const MetricFlags& metric_flags) {
  TrialOptions options;
  OptionTable table;
  Bind(&table, &options);
  trial_flags.Apply(&table);
  MetricOptions metric = metric_flags.Resolve();
  if (flags.millimetres) {
    metric.object_min_extent = 0.0;
    metric.units = LengthUnit::kMm;
  }
  if (!flags.out.empty()) const AtomicFile probe(flags.out);  // refused before the work
  const std::vector<InputObject> objects = LoadUsable(flags);
  WarnOfSizes(objects, metric);
  const std::vector<TrialReading> all = RunReadings(flags, objects, metric, options);
  std::vector<std::string> names;
  for (const InputObject& object : objects) names.push_back(object.name);
  if (!flags.out.empty()) {
    WriteFileAtomic(flags.out, TrialCsv(names, all));
    Bind(&table, &metric);
    WriteFileAtomic(flags.out + ".trial.toml", Constants(flags) + table.Dump());
  }
  std::fputs(TrialText(names, all, options.min_epsilon).c_str(), stdout);
}

constexpr const char* kAboutTrial =
    "A series plans anew: antipodal grasps with their robust quality. Then, five times, it draws "
    "a\n"
    "stable pose by its probability, takes the best grasp that the gripper reaches from above the\n"
    "table and that was not yet executed, and executes it three times under fresh noise.\n"
    "found: there was such a grasp. It holds when both jaws touch first from outside and the line\n"
    "between the contacts lies in both friction cones (force closure), and when epsilon is also\n"
    "above --min-epsilon. A grasp that was not found counts as not held. Reading half-angle takes\n"
    "the friction angle as the cone's half angle, full-cone as the opening of the whole cone.\n"
    "Intervals allow for executions of one series sharing a plan.\n";

}  // namespace

void AddTrialCommand(CLI::App* app) {
  const auto flags = std::make_shared<TrialFlags>();
  CLI::App* command = app->add_subcommand(
      "trial", "Predict how often a robot would lift objects (the paper's Table I)");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out,
                      "results (CSV); the constants go to the same name plus .trial.toml");
  command->add_option("--friction-angle", flags->friction_angle, "degrees")
      ->check(NumberIn(0.0, 80.0))
      ->capture_default_str();
  std::vector<std::string> readings = ChoiceNames<FrictionReading>();
  readings.emplace_back(kBoth);
  command->add_option("--reading", flags->reading, Alternatives(readings))
      ->check(CLI::IsMember(readings))
      ->capture_default_str();
  CLI::Option* mm = command->add_flag("--mm", flags->millimetres, "--units mm --true-size");
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all; results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  const auto trial_flags = std::make_shared<OptionFlags>(TrialOptionFlags(command));
  const auto metric_flags = std::make_shared<MetricFlags>(command);
  // Set by the friction angle, or without meaning here.
  for (const char* name : {"--friction", "--percentile"}) {
    command->remove_option(command->get_option(name));
  }
  for (const char* name : {"--units", "--object-min-extent"}) mm->excludes(name);
  command->footer(kAboutTrial);
  command->callback(
      [flags, trial_flags, metric_flags] { Trial(*flags, *trial_flags, *metric_flags); });
}

}  // namespace antigrasp
