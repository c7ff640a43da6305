#include "antigrasp/quality/judge.h"

#include <cmath>

namespace antigrasp {

std::string Judge::Toml() const {
  std::string name = Name(), text;
  const auto dump = [&](const OptionTable& settings) {
    OptionTable table;
    table.Add("judge.name", &name, {}, "who scored");
    table.AddAll(settings, "judge.");
    text = "\n" + table.Dump();
  };
  dump({});
  TellSettings(dump);
  return text;
}

Verdict Verdict::Of(double score) {
  return std::isfinite(score) ? Verdict{score, kOk} : None("not a finite number");
}

void VerdictCount::Add(const Verdict& verdict) {
  if (verdict.score) {
    ++scored_;
  } else {
    without_.Add(verdict.status);
  }
}

std::string VerdictCount::Text() const {
  const std::string without = without_.Text();
  return std::to_string(scored_) + " scored" + (without.empty() ? "" : ", ") + without;
}

}  // namespace antigrasp
