#pragma once

#include <functional>
#include <string>

#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// What somebody asks of the metric, beside single constants; what is empty was not asked for.
struct MetricChoice {
  std::string preset = "default";  // ApplyMetricPreset
  std::string noise;               // ApplyNoisePreset
  std::string gripper;             // ApplyGripper
  bool true_size = false;          // objects keep their size
};

// Single constants, as `apply` sets them in a table with keys "metric.*" and "gripper.*", go before
// noise and gripper, and those before the preset. InputError for unknown names and for parts that
// do not fit each other, named as they were `typed`, else as of `origin`.
MetricOptions ResolveMetric(const MetricChoice& choice,
                            const std::function<void(OptionTable*)>& apply,
                            const std::string& origin, const TypedOption& typed);

}  // namespace antigrasp
