#include "antigrasp/quality/sampling_effort.h"

#include <algorithm>

namespace antigrasp {

void RaiseEffortForFew(std::int64_t objects, MetricOptions* options) {
  if (objects > kFewObjects || options->num_grasps >= kGraspsOfFew) return;
  const std::int64_t attempts =
      std::int64_t{options->max_attempts} * kGraspsOfFew / options->num_grasps;
  options->max_attempts = static_cast<int>(std::min<std::int64_t>(attempts, 1'000'000'000));
  options->num_grasps = kGraspsOfFew;
}

std::string EffortRule() {
  return "Unless --num-grasps, --max-attempts or --preset says otherwise, an object gets " +
         std::to_string(kGraspsOfFew) +
         " grasps (from 10 times\nas many candidates) when there are at most " +
         std::to_string(kFewObjects) +
         " objects, and the numbers above when\nthere are more (docs/metric.md).";
}

std::string EffortText(std::int64_t objects, const MetricOptions& options) {
  return std::to_string(options.num_grasps) + " grasps an object, as there are " +
         (objects > kFewObjects ? "more than " : "at most ") + std::to_string(kFewObjects) +
         " objects";
}

}  // namespace antigrasp
