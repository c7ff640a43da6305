#include "antigrasp/quality/metric_choice.h"

#include "antigrasp/quality/named_gripper.h"

namespace antigrasp {

MetricOptions ResolveMetric(const MetricChoice& choice,
                            const std::function<void(OptionTable*)>& apply,
                            const std::string& origin, const TypedOption& typed) {
  MetricOptions options;
  ApplyMetricPreset(choice.preset, &options);
  if (!choice.noise.empty()) ApplyNoisePreset(choice.noise, &options);
  if (!choice.gripper.empty()) ApplyGripper(choice.gripper, &options);
  OptionTable table;
  Bind(&table, &options);
  apply(&table);
  if (choice.true_size) options.object_min_extent = 0.0;
  RequireFittingGripper(options, origin, typed);
  return options;
}

}  // namespace antigrasp
