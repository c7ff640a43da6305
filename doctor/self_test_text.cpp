#include <algorithm>
#include <cstdio>

#include "antigrasp/core/rng.h"
#include "antigrasp/doctor/self_test.h"

namespace antigrasp {
namespace {

std::string Hexadecimal(std::uint64_t hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

void Append(const std::string& text, const std::string& separator, std::string* to) {
  if (!text.empty()) *to += (to->empty() ? "" : separator) + text;
}

}  // namespace

std::uint64_t HashedBytes::Hash() const { return HashOf(text_); }

bool AllOk(const std::vector<SelfTestStep>& steps) {
  return std::all_of(steps.begin(), steps.end(),
                     [](const SelfTestStep& step) { return step.ok(); });
}

std::string SelfTestText(const std::vector<SelfTestStep>& steps) {
  std::string wrong, right, unknown;
  for (const SelfTestStep& step : steps) {
    if (!step.expected) {
      Append(step.name + " " + Hexadecimal(step.found), ", ", &unknown);
    } else if (step.ok()) {
      Append(step.name, ", ", &right);
    } else {
      Append(
          step.name + " " + Hexadecimal(step.found) + ", expected " + Hexadecimal(*step.expected),
          "; ", &wrong);
    }
  }
  std::string text = wrong.empty() ? "" : "OTHER BYTES: " + wrong;
  if (!right.empty()) Append(right + ": the expected bytes", "; ", &text);
  if (!unknown.empty()) Append("no bytes are known for " + unknown, "; ", &text);
  return text;
}

}  // namespace antigrasp
