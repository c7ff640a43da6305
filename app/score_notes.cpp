#include "antigrasp/app/score_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "antigrasp/quality/known_scores.h"

namespace antigrasp {
namespace {

std::vector<double> QualitiesOf(const Graspability& score) {
  std::vector<double> qualities;
  for (const ScoredGrasp& scored : score.grasps) qualities.push_back(scored.quality);
  return qualities;
}

std::string RangeText(const char* format, double low, double high) {
  char text[96];
  std::snprintf(text, sizeof text, format, low, high);
  return text;
}

}  // namespace

PairDifference DifferenceOf(const Graspability& changed, const Graspability& original,
                            double percentile) {
  // An object without a grasp scores 0, surely.
  std::vector<double> of_changed = QualitiesOf(changed), of_original = QualitiesOf(original);
  for (std::vector<double>* qualities : {&of_changed, &of_original}) {
    if (qualities->empty()) qualities->push_back(0.0);
  }
  return {changed.value - original.value,
          BootstrapPercentileDifference(std::move(of_changed), std::move(of_original), percentile)};
}

std::string PairText(const PairDifference& pair, double baseline) {
  const auto& [difference, interval] = pair;
  char text[64];
  std::snprintf(text, sizeof text, "paired difference %+.5f", difference);
  std::string line = text + RangeText(", 95 %% interval over its grasps %+.5f to %+.5f",
                                      interval.low, interval.high);
  if (!(baseline > 0.0)) return line + ", the baseline is 0, 1 pairs";
  const double percent = 100.0 / baseline;
  std::snprintf(text, sizeof text, ", %+.1f %%", percent * difference);
  line += text + RangeText(" (%+.1f to %+.1f)", percent * interval.low, percent * interval.high);
  std::snprintf(text, sizeof text, " of the baseline's %.5f, 1 pairs", baseline);
  return line + text;
}

std::string IntervalText(const Graspability& score) {
  std::string text =
      RangeText("95 %% interval over its grasps %.5f to %.5f", score.ci_low, score.ci_high);
  if (score.value > 0.0) {
    text += RangeText(", %+.1f to %+.1f %%", 100.0 * (score.ci_low / score.value - 1.0),
                      100.0 * (score.ci_high / score.value - 1.0));
  }
  return text;
}

std::string KnownText(double graspability, bool mean, const MetricOptions& metric) {
  const auto sets = KnownSetsAt(metric);
  if (sets.empty()) return "no known objects at these constants of the metric to set it beside";
  std::string text;
  const std::string head = mean ? "the mean is harder to grasp than " : "harder to grasp than ";
  for (const KnownSet* set : sets) {
    char share[32];
    std::snprintf(share, sizeof share, "%.0f %% of ",
                  100.0 * (1.0 - ShareBelow(graspability, *set)));
    text += (text.empty() ? head : ", ") + (share + std::string(set->name));
  }
  return text;
}

std::string SharedDrawsText(const ObjectSource& objects) {
  std::map<std::uint64_t, int> sharers;
  int most = 0;
  for (std::int64_t i = 0; i < objects.size(); ++i) {
    most = std::max(most, ++sharers[objects.stream(i)]);
  }
  if (most < 2) return "";
  return std::to_string(most) +
         " objects have one name and with it the same draws: each score is as good as any, but "
         "their "
         "mean is less certain than its interval says";
}

}  // namespace antigrasp
