#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/sdf/marching_cubes.h"
#include "antigrasp/trial/physics_trial.h"
#include "bench/compare.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

int Executions(const PhysicsTrial& trial) {
  int count = 0;
  for (const ExecutedGrasp& grasp : trial.grasps) count += static_cast<int>(grasp.draws.size());
  return count;
}

// Percent of the executions whose first stage came out alike.
double Alike(const PhysicsTrial& a, const PhysicsTrial& b) {
  int alike = 0;
  for (std::size_t g = 0; g < a.grasps.size(); ++g) {
    for (std::size_t k = 0; k < a.grasps[g].draws.size(); ++k) {
      const auto held = [&](const PhysicsTrial& trial) {
        return trial.grasps[g].draws[k].execution.stages > 0;
      };
      alike += held(a) == held(b) ? 1 : 0;
    }
  }
  return 100.0 * alike / Executions(a);
}

// An object as `dataset make KIND --seed SEED` makes its first one.
TriangleMesh FirstOf(const std::string& kind, std::uint64_t seed) {
  PriorSetOptions options;
  options.kind = kind;
  options.count = 1;
  options.seed = seed;
  return MarchingCubes(MakePriorSet(options).grids.front());
}

PhysicsTrial Try(const TriangleMesh& mesh, int threads, Pace pace) {
  return PhysicsTrials(MetricOptions{}, {}, 7, threads, pace).Try(mesh, 0);
}

void CompareOne(const std::string& name, const TriangleMesh& mesh) {
  PhysicsTrial early, fixed;
  const std::vector<double> seconds =
      MedianSeconds({{"early", [&] { early = Try(mesh, 1, Pace::kEarly); }},
                     {"fixed", [&] { fixed = Try(mesh, 1, Pace::kFixed); }},
                     {"two threads", [&] { static_cast<void>(Try(mesh, 2, Pace::kEarly)); }}},
                    3);
  const double executions = Executions(early);
  std::printf(
      "trials of %s: %.0f executions a second on one core, %.0f with fixed phases; %.1f %% of the "
      "outcomes alike\n",
      name.c_str(), executions / seconds[0], executions / seconds[1], Alike(early, fixed));
  PrintRatio("trials_early_vs_fixed_phases_" + name, seconds[1] / seconds[0]);
  PrintRatio("trials_two_threads_vs_one_" + name, seconds[0] / seconds[2]);
}

}  // namespace

// Executions that end when nothing can change any more, beside phases simulated to their end: 100
// grasps of an object five times, planning included.
void CompareTrials() {
  CompareOne("cylinders", FirstOf("cylinders", 1));
  CompareOne("prisms", FirstOf("prisms", 77));
  CompareOne("bottles", FirstOf("bottles", 77));
}

}  // namespace antigrasp::bench
