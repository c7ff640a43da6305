#include "antigrasp/quality/judge.h"

#include <algorithm>
#include <cmath>

namespace antigrasp {

Verdict Verdict::Of(double score) {
  return std::isfinite(score) ? Verdict{score, kOk} : None("not a finite number");
}

void VerdictCount::Add(const Verdict& verdict) {
  if (verdict.score) {
    ++scored_;
    return;
  }
  const auto known = std::find_if(without_.begin(), without_.end(),
                                  [&](const auto& one) { return one.first == verdict.status; });
  if (known != without_.end()) {
    ++known->second;
  } else {
    without_.emplace_back(verdict.status, 1);
  }
}

std::string VerdictCount::Text() const {
  std::string text = std::to_string(scored_) + " scored";
  for (const auto& [status, count] : without_) text += ", " + std::to_string(count) + " " + status;
  return text;
}

}  // namespace antigrasp
