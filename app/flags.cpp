#include "antigrasp/app/flags.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>

#include "antigrasp/core/format.h"
#include "antigrasp/quality/metric_choice.h"
#include "antigrasp/quality/named_gripper.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

std::shared_ptr<std::string> AddName(CLI::App* command, const std::string& flag,
                                     const std::string& value, const std::string& help) {
  const auto name = std::make_shared<std::string>(value);
  command->add_option(flag, *name, help)->type_name("NAME")->capture_default_str()->group("Metric");
  return name;
}

std::vector<std::string> GripperAlternatives() {
  std::vector<std::string> names;
  for (const NamedGripper& gripper : NamedGrippers()) names.emplace_back(gripper.name);
  names.emplace_back("a TOML file");
  return names;
}

}  // namespace

std::string FlagOf(const std::string& key) {
  std::string flag = "--" + key.substr(key.starts_with("gripper.") ? 0 : key.rfind('.') + 1);
  std::replace(flag.begin() + 2, flag.end(), '_', '-');
  std::replace(flag.begin() + 2, flag.end(), '.', '-');
  return flag;
}

std::shared_ptr<std::string> AddGripperFlag(CLI::App* command, const std::string& group) {
  const auto name = std::make_shared<std::string>();
  command
      ->add_option("--gripper", *name,
                   "opening, fingers and palm: " + Alternatives(GripperAlternatives()))
      ->type_name("NAME|FILE")
      ->group(group);
  return name;
}

CLI::Option* AddHardestFlag(CLI::App* command, int* count, const std::string& help) {
  return command->add_option("--hardest", *count, help)
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
}

CLI::Validator NumberIn(double low, double high) {
  const std::string range = "[" + FormatDouble(low) + " - " + FormatDouble(high) + "]";
  return {[low, high, range](const std::string& text) {
            double value = 0.0;
            const bool read = CLI::detail::lexical_cast(text, value);
            return read && value >= low && value <= high
                       ? std::string()
                       : "Value " + text + " not in range " + range;
          },
          "FLOAT in " + range, "NumberIn"};
}

void AddThreads(CLI::App* command, int* threads, const std::string& note) {
  command->add_option("--threads", *threads, "threads; 0 = all" + note)
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
}

void AddProcesses(CLI::App* command, int* processes) {
  command->add_option("--processes", *processes, "on this machine, to share the work")
      ->check(CLI::Range(1, 1024));
}

void AddOverwrite(CLI::App* command, bool* overwrite) {
  command->add_flag(
      "--overwrite", *overwrite,
      "replace what an earlier call wrote into --out, and files of the names that this one may "
      "write; others there stay");
}

OptionFlags::OptionFlags(CLI::App* command, const OptionTable& table, const std::string& group) {
  for (const Option& option : table.options()) {
    const auto given = given_;
    const std::string& key = option.key;
    if (std::holds_alternative<bool*>(option.target)) {
      const std::string flag = FlagOf(key);
      command
          ->add_flag_function(
              flag + ",!--no-" + flag.substr(2),
              [given, key](std::int64_t count) { (*given)[key] = count > 0 ? "true" : "false"; },
              option.help)
          ->group(group);
      continue;
    }
    command
        ->add_option_function<std::string>(
            FlagOf(key), [given, key](const std::string& text) { (*given)[key] = text; },
            option.help)
        ->type_name(ValueText(option))
        ->group(group);
  }
}

void OptionFlags::Apply(OptionTable* table) const {
  for (const auto& [key, text] : *given_) table->ApplyValue(key, text, FlagOf(key));
}

std::string OptionFlags::Typed(const std::string& key) const {
  const auto given = given_->find(key);
  return given == given_->end() ? "" : FlagOf(key) + " " + given->second;
}

MetricFlags::MetricFlags(CLI::App* command)
    : command_(command),
      preset_(AddName(command, "--preset", "default",
                      "all constants: " + Alternatives(MetricPresetNames()))),
      noise_(AddName(command, "--noise", "", "noise alone: " + Alternatives(NoisePresetNames()))),
      gripper_(AddGripperFlag(command, "Metric")),
      options_(AddOptions<MetricOptions>(command, "Metric")) {
  command
      ->add_flag("--true-size", *true_size_,
                 "score objects at the size they have, their coordinates in --units, instead of "
                 "rescaling each")
      ->group("Metric")
      ->excludes("--object-min-extent");
}

bool MetricFlags::given() const {
  return options_.given() || command_->count("--preset") > 0 || command_->count("--noise") > 0 ||
         command_->count("--gripper") > 0 || *true_size_;
}

bool MetricFlags::effort_given() const {
  return command_->count("--preset") + command_->count("--num-grasps") +
             command_->count("--max-attempts") >
         0;
}

void MetricFlags::RaiseEffort(std::int64_t objects, MetricOptions* options) const {
  if (!effort_given()) RaiseEffortForFew(objects, options);
}

MetricOptions MetricFlags::Resolve() const {
  const TypedOption typed = [this](const std::string& key) { return options_.Typed(key); };
  const MetricOptions options = ResolveMetric(
      {*preset_, *noise_, *gripper_, *true_size_},
      [this](OptionTable* table) { options_.Apply(table); }, "command line", typed);
  WarnOfLengths(options, typed);
  return options;
}

void WarnOfLengths(const MetricOptions& metric, const TypedOption& typed) {
  for (const std::string& text : UnlikelyLengths(metric, typed)) spdlog::warn("{}", text);
}

void AddUnits(CLI::App* command, LengthUnit* units, const std::string& help) {
  AddChoice(command, "--units", units,
            "what the coordinates are in: " + Alternatives(ChoiceNames<LengthUnit>()) + help +
                "; 3MF, GLB and DAE say it themselves");
}

}  // namespace antigrasp
