#include "antigrasp/doctor/examine.h"

#include <cstdio>

#include "antigrasp/core/error.h"
#include "antigrasp/doctor/build_facts.h"
#include "antigrasp/doctor/self_test.h"

namespace antigrasp {

void PrintNow(const std::string& lines) {
  std::fputs(lines.c_str(), stdout);
  std::fflush(stdout);
}

void Examine(const PrintFn& print, const std::function<ChildEnd()>& networks,
             RunObserver* observer) {
  print(BuildFacts());
  const std::vector<SelfTestStep> steps = RunSelfTest(0, observer);
  print(FactLine("self-test", SelfTestText(steps)));
  const ChildEnd end = BuiltWithNetworks() ? networks() : ChildEnd();
  if (end.code != 0 && end.code != kOtherBytes) {
    throw RuntimeFailure("antigrasp-networks failed: " + end.text);
  }
  if (!AllOk(steps) || end.code == kOtherBytes) {
    throw RuntimeFailure("the self-test gave other bytes than expected (above)");
  }
}

}  // namespace antigrasp
