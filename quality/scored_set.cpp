#include "antigrasp/quality/scored_set.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

// "harder_than_cylinders_adversarial_pct".
std::string PercentileColumn(const KnownSet& set) {
  std::string name = "harder_than_" + std::string(set.name) + "_pct";
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace

ScoreRow ScoredSet::Add(const ScoredObject& scored, const ScoredObject* original) {
  const double value = scored.Value();
  const double baseline = original != nullptr ? original->Value() : 0.0;
  interval_.clear();
  pair_.reset();
  if (values_.empty()) {
    first_ = scored.name + ": " + scored.status;
    if (!scored.score.grasps.empty()) interval_ = IntervalText(scored.score);
    if (std::isfinite(value + baseline) && original != nullptr) {
      pair_ = DifferenceOf(scored.score, original->score, metric_);
    }
  }
  values_.push_back(value);
  if (scored.score.status == GraspabilityStatus::kNoGrasps) {
    no_grasps_.push_back(scored.name);
  } else if (std::isfinite(value)) {
    with_grasps_.push_back(value);
  }
  if (original != nullptr) originals_.push_back(baseline);
  if (!scored.note.empty()) AddNote(scored.name + ": " + scored.note);
  candidates_.Add(scored.score);
  sizes_.Add(scored.name, scored.extent, &scored.score);
  ScoreRow row = RowOf(scored, egad_, original != nullptr ? &baseline : nullptr);
  for (const KnownSet* set : known_) {
    const double percent = std::round(1e4 * (1.0 - ShareBelow(value, *set))) / 100.0;
    const bool has_grasps = !scored.score.grasps.empty();
    row.extras.emplace_back(PercentileColumn(*set), has_grasps ? percent : std::nan(""));
  }
  return row;
}

void ScoredSet::RequireAScore(const std::string& where) const {
  const auto has_none = [](double value) { return std::isnan(value); };
  if (!std::all_of(values_.begin(), values_.end(), has_none)) return;
  throw InputError("no object scored; " + first_, where, "a closed solid");
}

std::vector<std::string> ScoredSet::Warnings() const {
  std::vector<std::string> warnings = notes_;
  for (std::string& text : sizes_.Texts()) warnings.push_back(std::move(text));
  return warnings;
}

std::vector<std::string> ScoredSet::Summary(bool effort_given) const {
  std::vector<std::string> lines = {MeanScoreText(values_, metric_), candidates_.Text()};
  if (!interval_.empty()) lines.push_back(interval_);
  if (!effort_given) lines.push_back(EffortText(std::ssize(values_), metric_));
  if (!no_grasps_.empty()) {
    lines.push_back("no grasp, graspability 0 (status no_grasps): " + FirstNames(no_grasps_));
  }
  if (!with_grasps_.empty()) {
    const MeanInterval mean = MeanWithInterval(with_grasps_);
    std::string known = KnownText(mean.mean, mean.count > 1, metric_);
    if (!no_grasps_.empty() && !known_.empty()) known += "; of those with a grasp";
    lines.push_back(known);
  }
  lines.insert(lines.end(), lines_.begin(), lines_.end());
  return lines;
}

std::string ScoredSet::PairedDifference() const {
  return pair_ ? PairText(*pair_, originals_.front()) : PairsText(values_, originals_);
}

}  // namespace antigrasp
