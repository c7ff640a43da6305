#include "antigrasp/app/flags.h"

#include <algorithm>
#include <map>

namespace antigrasp {

struct MetricFlags::State {
  std::string noise;
  std::map<std::string, std::string> given;  // key -> text
};

std::string FlagOf(const std::string& key) {
  std::string flag = "--" + key.substr(key.rfind('.') + 1);
  std::replace(flag.begin() + 2, flag.end(), '_', '-');
  return flag;
}

MetricFlags::MetricFlags(CLI::App* command) : state_(std::make_shared<State>()) {
  command->add_option("--noise", state_->noise, "noise preset: default, dexnet or none")
      ->type_name("PRESET")
      ->group("Metric");
  MetricOptions defaults;
  OptionTable table;
  Bind(&table, &defaults);
  for (const Option& option : table.options()) {
    command
        ->add_option_function<std::string>(
            FlagOf(option.key),
            [state = state_, key = option.key](const std::string& text) {
              state->given[key] = text;
            },
            option.help)
        ->type_name(ValueText(option))
        ->group("Metric");
  }
}

MetricOptions MetricFlags::Resolve() const {
  MetricOptions options;
  if (!state_->noise.empty()) ApplyNoisePreset(state_->noise, &options);
  OptionTable table;
  Bind(&table, &options);
  for (const auto& [key, text] : state_->given) table.ApplyValue(key, text, FlagOf(key));
  return options;
}

}  // namespace antigrasp
