#include <cmath>
#include <string>

#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/epsilon_closed_form.h"
#include "antigrasp/quality/epsilon_general.h"
#include "bench/compare.h"
#include "bench/peer_evaluation.h"
#include "bench/timing.h"
#include "tests/quality/random_grasps.h"

namespace antigrasp::bench {
namespace {

// Grasps with both contacts inside each other's pyramid, at Dex-Net's constants: what the metric
// meets nearly always.
std::vector<RandomGrasp> ClosedFormGrasps(std::size_t count) {
  std::vector<RandomGrasp> grasps;
  for (std::uint64_t i = 0; grasps.size() < count; ++i) {
    RngStream rng(1, "bench", i);
    RandomGrasp grasp = DrawRandomGrasp(0.9, 8, &rng);
    grasp.model = WrenchModel{};
    const TangentFrames frames{TangentFrame(-grasp.contacts[0].normal),
                               TangentFrame(-grasp.contacts[1].normal)};
    const auto map = MakeDualMap(grasp.contacts, grasp.com, grasp.model, frames);
    if (map && MaxNorm2ClosedForm(*map)) grasps.push_back(grasp);
  }
  return grasps;
}

std::vector<DualMap> MapsOf(const std::vector<RandomGrasp>& grasps) {
  std::vector<DualMap> maps;
  for (const RandomGrasp& grasp : grasps) {
    const TangentFrames frames{TangentFrame(-grasp.contacts[0].normal),
                               TangentFrame(-grasp.contacts[1].normal)};
    maps.push_back(*MakeDualMap(grasp.contacts, grasp.com, grasp.model, frames));
  }
  return maps;
}

template <typename Evaluate>
Contender Loop(const std::string& name, std::size_t count, std::size_t passes, double* sink,
               Evaluate evaluate) {
  return {name,
          [=] {
            double sum = 0.0;
            for (std::size_t pass = 0; pass < passes; ++pass) {
              for (std::size_t i = 0; i < count; ++i) sum += evaluate(i);
            }
            *sink += sum;  // the compiler must not drop the work
          },
          static_cast<double>(count * passes)};
}

}  // namespace

void CompareEpsilon() {
  constexpr std::size_t kGrasps = 200;
  static double sink = 0.0;
  const std::vector<RandomGrasp> grasps = ClosedFormGrasps(kGrasps);
  const std::vector<DualMap> maps = MapsOf(grasps);
  std::vector<Contender> contenders{
      Loop("epsilon_qhull_qt", kGrasps, 1, &sink,
           [&](std::size_t i) {
             return EpsilonByQhull(grasps[i].contacts, grasps[i].com, grasps[i].model);
           }),
      Loop("epsilon_general", kGrasps, 20, &sink,
           [&](std::size_t i) { return *MaxNorm2General(MakeWrenchDual(maps[i])); }),
      Loop("epsilon", kGrasps, 500, &sink, [&](std::size_t i) {
        return Epsilon(grasps[i].contacts, grasps[i].com, grasps[i].model);
      })};
  for (const SimdLevel level : SupportedSimdLevels()) {
    contenders.push_back(Loop(std::string("epsilon_closed_form_") + Name(level), kGrasps, 500,
                              &sink, [&maps, level](std::size_t i) {
                                return 1.0 / std::sqrt(*MaxNorm2ClosedForm(maps[i], level));
                              }));
  }
  const std::vector<double> seconds = MedianSeconds(contenders, 7);
  for (std::size_t i = 0; i < contenders.size(); ++i) PrintTime(contenders[i].name, seconds[i]);
  for (std::size_t i = 1; i < contenders.size(); ++i) {
    PrintRatio(contenders[i].name + "_vs_qhull", seconds[0] / seconds[i]);
  }
}

}  // namespace antigrasp::bench
