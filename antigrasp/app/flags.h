#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// The metric's constants as flags of a command: --friction, --num-draws, ... (one per "metric.*"
// option, ranges and help from the same table) and --noise PRESET. Flags given win over the preset.
class MetricFlags {
 public:
  explicit MetricFlags(CLI::App* command);
  // Call after parsing. InputError for a value out of range.
  MetricOptions Resolve() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

// "metric.num_grasps" -> "--num-grasps".
std::string FlagOf(const std::string& key);

}  // namespace antigrasp
