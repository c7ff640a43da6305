#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "antigrasp/core/choice.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// The options of a table as flags of a command: "metric.num_draws" is --num-draws, help and default
// from the table; a boolean is --name or --no-name.
class OptionFlags {
 public:
  OptionFlags(CLI::App* command, const OptionTable& table, const std::string& group);
  // Call after parsing: what was given, into a table with the same keys. InputError for a value out
  // of range.
  void Apply(OptionTable* table) const;
  std::string Typed(const std::string& key) const;  // "--friction 0.3"; "" when it was not given
  bool given() const { return !given_->empty(); }

 private:
  using Given = std::map<std::string, std::string>;  // key -> text
  std::shared_ptr<Given> given_ = std::make_shared<Given>();
};

// The flags of an options struct that has a Bind, and after parsing the options that were given.
template <typename Options>
OptionFlags AddOptions(CLI::App* command, const std::string& group) {
  Options defaults;
  OptionTable table;
  Bind(&table, &defaults);
  return {command, table, group};
}
template <typename Options>
Options GivenOptions(const OptionFlags& flags) {
  Options options;
  OptionTable table;
  Bind(&table, &options);
  flags.Apply(&table);
  return options;
}

// The metric's constants as flags of a command: one per "metric.*" and "gripper.*" option,
// --preset NAME, --noise PRESET, --gripper NAME|FILE and --true-size. Single constants win over
// --noise and --gripper, those over --preset.
class MetricFlags {
 public:
  explicit MetricFlags(CLI::App* command);
  // Both after parsing. InputError for parts that do not fit each other; warns of lengths that can
  // hardly be in metres.
  MetricOptions Resolve() const;
  // More grasps for few objects (quality/sampling_effort.h), unless effort_given().
  void RaiseEffort(std::int64_t objects, MetricOptions* options) const;
  bool effort_given() const;  // --preset, --num-grasps or --max-attempts
  const std::string& preset() const { return *preset_; }
  const std::string& gripper() const { return *gripper_; }  // a name or a file
  bool given() const;  // whether any of them was on the command line

 private:
  CLI::App* command_;
  std::shared_ptr<std::string> preset_, noise_, gripper_;
  std::shared_ptr<bool> true_size_ = std::make_shared<bool>(false);
  OptionFlags options_;
};

// --gripper NAME|FILE (quality/named_gripper.h); empty when it is not given.
std::shared_ptr<std::string> AddGripperFlag(CLI::App* command, const std::string& group);

// Warnings for lengths that can hardly be in metres (UnlikelyLengths).
void WarnOfLengths(const MetricOptions& metric, const TypedOption& typed = nullptr);

// --units of a command without the metric's constants; the target must live until it has run.
void AddUnits(CLI::App* command, LengthUnit* units, const std::string& help);

// --threads, 0 = all; `note` follows in its help: "; scores do not depend on it".
void AddThreads(CLI::App* command, int* threads, const std::string& note = "");

// --processes N of a command whose work is shared (core/work_share.h).
void AddProcesses(CLI::App* command, int* processes);

// --hardest N; 0 when it is not given.
CLI::Option* AddHardestFlag(CLI::App* command, int* count, const std::string& help);

// A number in [low, high]; unlike CLI::Range it refuses nan.
CLI::Validator NumberIn(double low, double high);

// An enum as a flag, with the names of choice.h. The target must live until the command has run.
template <Chosen E>
void AddChoice(CLI::App* command, const std::string& flag, E* target, const std::string& help) {
  command
      ->add_option_function<std::string>(
          flag, [target](const std::string& name) { *target = *FindChoice<E>(name); }, help)
      ->check(CLI::IsMember(ChoiceNames<E>()))
      ->default_str(ChoiceName(*target));
}

// --overwrite of a command that fills a folder (datasets/result_folder.h).
void AddOverwrite(CLI::App* command, bool* overwrite);

// "metric.num_grasps" -> "--num-grasps"; the gripper's keep their section: "gripper.palm_width" ->
// "--gripper-palm-width".
std::string FlagOf(const std::string& key);

}  // namespace antigrasp
