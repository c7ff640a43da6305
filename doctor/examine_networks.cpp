#include "antigrasp/doctor/examine_networks.h"

#include "antigrasp/doctor/build_facts.h"
#include "antigrasp/doctor/network_facts.h"

namespace antigrasp {

bool ExamineNetworks(const PrintFn& print) {
  print(NetworkFacts());
  const std::vector<SelfTestStep> steps = RunNetworkSelfTest();
  print(FactLine("self-test", SelfTestText(steps)));
  return AllOk(steps);
}

}  // namespace antigrasp
