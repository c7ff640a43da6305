#include "antigrasp/quality/score_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "antigrasp/quality/known_scores.h"
#include "antigrasp/quality/object_size.h"

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

std::string Formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// " +-0.00012 (95 %)"; nothing for a single object, which says nothing about the spread.
std::string HalfWidth(const char* format, double half_width) {
  return std::isfinite(half_width) ? Formatted(format, half_width) : "";
}

}  // namespace

PairDifference DifferenceOf(const Graspability& changed, const Graspability& original,
                            const MetricOptions& metric) {
  // An object without a grasp scores 0, surely.
  std::vector<double> of_changed = QualitiesOf(changed), of_original = QualitiesOf(original);
  for (std::vector<double>* qualities : {&of_changed, &of_original}) {
    if (qualities->empty()) qualities->push_back(0.0);
  }
  const double difference = changed.value - original.value;
  if (metric.summary == Summary::kMean) {
    const double half = std::hypot(MeanWithInterval(of_changed).half_width,
                                   MeanWithInterval(of_original).half_width);
    return {difference, {difference - half, difference + half}};
  }
  return {difference, BootstrapPercentileDifference(std::move(of_changed), std::move(of_original),
                                                    metric.percentile)};
}

std::string PairText(const PairDifference& pair, double baseline) {
  const auto& [difference, interval] = pair;
  const std::string line =
      Formatted("paired difference %+.5f", difference) +
      RangeText(", 95 %% interval over its grasps %+.5f to %+.5f", interval.low, interval.high);
  if (!(baseline > 0.0)) return line + ", the baseline is 0, 1 pairs";
  const double percent = 100.0 / baseline;
  return line + Formatted(", %+.1f %%", percent * difference) +
         RangeText(" (%+.1f to %+.1f)", percent * interval.low, percent * interval.high) +
         Formatted(" of the baseline's %.5f, 1 pairs", baseline);
}

std::string PairsText(const std::vector<double>& changed, const std::vector<double>& originals) {
  std::vector<double> difference, of_pairs;
  for (std::size_t i = 0; i < changed.size(); ++i) {
    difference.push_back(changed[i] - originals[i]);
    of_pairs.push_back(originals[i] + 0.0 * changed[i]);  // NaN where either is
  }
  const MeanInterval mean = MeanWithInterval(difference);
  const double baseline = MeanWithInterval(of_pairs).mean;
  if (mean.count == 0) return "no paired difference: no object and its baseline both have a score";
  std::string line = Formatted("paired difference %+.5f", mean.mean) +
                     HalfWidth(" +-%.5f (95 %%)", mean.half_width);
  if (baseline > 0.0) {
    line += Formatted(", %+.1f", 100.0 * mean.mean / baseline) +
            HalfWidth(" +-%.1f", 100.0 * mean.half_width / baseline) +
            Formatted(" %% of the baseline's %.5f", baseline);
  } else {
    line += ", the baseline is 0";
  }
  return line + ", " + std::to_string(mean.count) + " pairs";
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

std::string MeanScoreText(const std::vector<double>& scores, const MetricOptions& metric) {
  const MeanInterval mean = MeanWithInterval(scores);
  const char* const what = metric.closing == ClosingEnd::kSettled ? "mean share held when settled "
                                                                  : "mean graspability ";
  return std::to_string(mean.count) + " objects scored, " +
         std::to_string(static_cast<int>(scores.size()) - mean.count) + " not: " + what +
         Formatted("%.5f", mean.mean) + HalfWidth(" +-%.5f (95 %%)", mean.half_width) + ", " +
         SizeText(metric);
}

std::string KnownText(double graspability, bool mean, const MetricOptions& metric) {
  const auto sets = KnownSetsAt(metric);
  if (sets.empty()) return "no known objects at these constants of the metric to set it beside";
  std::string text;
  const std::string head = mean ? "the mean is harder to grasp than " : "harder to grasp than ";
  for (const KnownSet* set : sets) {
    text += (text.empty() ? head : ", ") +
            Formatted("%.0f %% of ", 100.0 * (1.0 - ShareBelow(graspability, *set))) +
            std::string(set->name);
  }
  return text;
}

std::string FirstNames(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string text = std::to_string(names.size()) + ": ";
  for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  if (names.size() <= kShown) return text;
  return text + " and " + std::to_string(names.size() - kShown) + " more";
}

std::string SharedDrawsText(const std::vector<std::uint64_t>& streams) {
  std::map<std::uint64_t, int> sharers;
  int most = 0;
  for (const std::uint64_t stream : streams) most = std::max(most, ++sharers[stream]);
  if (most < 2) return "";
  return std::to_string(most) +
         " objects have one name and with it the same draws: each score is as good as any, but "
         "their mean is less certain than its interval says";
}

}  // namespace antigrasp
