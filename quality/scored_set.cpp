#include "antigrasp/quality/scored_set.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {

ScoreRow ScoredSet::Add(const ScoredObject& scored, const ScoredObject* original) {
  const double value = scored.Value();
  const double baseline = original != nullptr ? original->Value() : 0.0;
  interval_.clear();
  pair_.reset();
  if (values_.empty()) {
    first_ = scored.name + ": " + scored.status;
    if (std::isfinite(value)) interval_ = IntervalText(scored.score);
    if (std::isfinite(value + baseline) && original != nullptr) {
      pair_ = DifferenceOf(scored.score, original->score, metric_.percentile);
    }
  }
  values_.push_back(value);
  if (original != nullptr) originals_.push_back(baseline);
  if (!scored.note.empty()) AddNote(scored.name + ": " + scored.note);
  candidates_.Add(scored.score);
  sizes_.Add(scored.name, scored.extent, &scored.score);
  return RowOf(scored, egad_, original != nullptr ? &baseline : nullptr);
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
  const MeanInterval mean = MeanWithInterval(values_);
  lines.push_back(KnownText(mean.mean, mean.count > 1, metric_));
  return lines;
}

std::string ScoredSet::PairedDifference() const {
  return pair_ ? PairText(*pair_, originals_.front()) : PairsText(values_, originals_);
}

}  // namespace antigrasp
