#include "antigrasp/quality/known_scores.h"

#include <algorithm>

#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

const std::vector<KnownSet>& AllKnownSets() {
  static const std::vector<KnownSet> kSets = {
#include "antigrasp/quality/known_scores.inc"
  };
  return kSets;
}

// As text, every constant but those that change how well the same number is estimated.
std::string Definition(MetricOptions options) {
  options.num_grasps = options.max_attempts = 1;
  options.adaptive = false;
  if (!AtTrueSize(options)) options.units = MetricOptions().units;  // rescaling takes them out
  return MetricToml(options, 0);
}

}  // namespace

std::vector<const KnownSet*> KnownSetsAt(const MetricOptions& options) {
  std::vector<const KnownSet*> sets;
  const std::string wanted = Definition(options);
  for (const KnownSet& set : AllKnownSets()) {
    MetricOptions preset;
    ApplyMetricPreset(std::string(set.preset), &preset);
    if (Definition(preset) == wanted) sets.push_back(&set);
  }
  return sets;
}

double ShareBelow(double graspability, const KnownSet& set) {
  const auto [low, high] = std::equal_range(set.scores.begin(), set.scores.end(), graspability);
  const auto below = static_cast<double>(low - set.scores.begin()),
             equal = static_cast<double>(high - low);
  return (below + 0.5 * equal) / static_cast<double>(set.scores.size());
}

}  // namespace antigrasp
