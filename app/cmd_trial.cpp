#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/object_notes.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/trial.h"

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

// The trials of all objects under one reading of the friction angle.
struct Readings {
  FrictionReading reading;
  double friction;
  std::vector<TrialResult> results;
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

std::vector<Readings> RunReadings(const TrialFlags& flags, const std::vector<InputObject>& objects,
                                  MetricOptions metric, const TrialOptions& options) {
  if (flags.millimetres) metric.object_min_extent = 0.0;
  std::vector<TriangleMesh> meshes;
  for (const InputObject& object : objects) {
    meshes.push_back(
        Transformed(object.mesh, flags.millimetres ? 1e-3 : 1.0, Eigen::Vector3d::Zero()));
  }
  ConsoleObserver console;
  std::vector<Readings> all;
  const auto chosen = FindChoice<FrictionReading>(flags.reading);
  for (const auto [reading, name] : ChoicesOf(FrictionReading{})) {
    if (chosen && chosen != reading) continue;
    metric.friction = FrictionCoefficient(flags.friction_angle, reading);
    all.push_back({reading, metric.friction,
                   RunTrials(meshes, metric, options, flags.seed, flags.threads,
                             console.Phase("trials, " + std::string(name)))});
  }
  return all;
}

double ShareOf(int count, int total) { return static_cast<double>(count) / total; }

std::string TrialCsv(const std::vector<InputObject>& objects, const std::vector<Readings>& all) {
  CsvWriter csv({"object", "reading", "friction", "poses", "grasps", "found", "holds_planned",
                 "confidence", "force_closure", "force_closure_low", "force_closure_high", "held",
                 "held_low", "held_high"});
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (const Readings& readings : all) {
      const TrialResult& result = readings.results[i];
      csv.Text(objects[i].name).Text(ChoiceName(readings.reading)).Number(readings.friction);
      csv.Count(result.poses).Count(result.grasps).Count(result.found).Count(result.holds_planned);
      csv.Number(result.confidence);
      for (const Share* share : {&result.force_closure, &result.held}) {
        csv.Numbers({share->value, share->interval.low, share->interval.high});
      }
      csv.EndRow();
    }
  }
  return csv.text();
}

std::string Constants(const TrialFlags& flags) {
  return "seed = " + std::to_string(flags.seed) +
         "\nfriction_angle = " + FormatDouble(flags.friction_angle) + "\nreading = \"" +
         flags.reading + "\"\nmillimetres = " + (flags.millimetres ? "true" : "false") +
         "\n# Not used below: metric.friction, which the friction angle sets, and "
         "metric.percentile" +
         (flags.millimetres ? ", metric.object_min_extent" : "") + ".\n\n";
}

std::string ShareText(const Share& share) {
  char text[64];
  std::snprintf(text, sizeof text, "%5.1f [%5.1f, %5.1f]", 100.0 * share.value,
                100.0 * share.interval.low, 100.0 * share.interval.high);
  return std::isnan(share.value) ? "" : text;
}

void PrintTable(const std::vector<InputObject>& objects, const std::vector<Readings>& all,
                const TrialOptions& options) {
  int width = 6;
  for (const InputObject& object : objects) {
    width = std::max(width, static_cast<int>(object.name.size()));
  }
  char limit[32];
  std::snprintf(limit, sizeof limit, "epsilon > %g", options.min_epsilon);
  std::printf("%% of the grasps     %*s planned             executed under noise [95 %%]\n",
              width + 3, "");
  std::printf("%-*s  reading     friction  found  %s  force closure         %s\n", width, "object",
              limit, limit);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (const Readings& readings : all) {
      const TrialResult& result = readings.results[i];
      std::printf("%-*s  %-10s  %8.4f  %5.1f  %15.1f  %s  %s\n", width, objects[i].name.c_str(),
                  ChoiceName(readings.reading).c_str(), readings.friction,
                  100.0 * ShareOf(result.found, result.grasps),
                  100.0 * ShareOf(result.holds_planned, result.grasps),
                  ShareText(result.force_closure).c_str(), ShareText(result.held).c_str());
    }
  }
}

void Trial(const TrialFlags& flags, const OptionFlags& trial_flags,
           const MetricFlags& metric_flags) {
  TrialOptions options;
  OptionTable table;
  Bind(&table, &options);
  trial_flags.Apply(&table);
  MetricOptions metric = metric_flags.Resolve();
  if (!flags.out.empty()) const AtomicFile probe(flags.out);  // refused before the work
  const std::vector<InputObject> objects = LoadUsable(flags);
  const std::vector<Readings> all = RunReadings(flags, objects, metric, options);
  if (!flags.out.empty()) {
    WriteFileAtomic(flags.out, TrialCsv(objects, all));
    Bind(&table, &metric);
    WriteFileAtomic(flags.out + ".trial.toml", Constants(flags) + table.Dump());
  }
  PrintTable(objects, all, options);
}

constexpr const char* kAbout =
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
  command->add_flag("--mm", flags->millimetres,
                    "coordinates are millimetres and objects keep their size; else each is "
                    "rescaled to --object-min-extent");
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
  command->footer(kAbout);
  command->callback(
      [flags, trial_flags, metric_flags] { Trial(*flags, *trial_flags, *metric_flags); });
}

}  // namespace antigrasp
