#include <cstdio>

#include "antigrasp/trial/physics_trial.h"
#include "bench/bench_objects.h"
#include "bench/compare.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

int Executions(const std::vector<PhysicsTrial>& trials) {
  int count = 0;
  for (const PhysicsTrial& trial : trials) {
    for (const ExecutedGrasp& grasp : trial.grasps) count += static_cast<int>(grasp.draws.size());
  }
  return count;
}

// Percent of the executions whose first stage came out alike.
double Alike(const std::vector<PhysicsTrial>& a, const std::vector<PhysicsTrial>& b) {
  int alike = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t g = 0; g < a[i].grasps.size(); ++g) {
      for (std::size_t k = 0; k < a[i].grasps[g].draws.size(); ++k) {
        const auto held = [&](const std::vector<PhysicsTrial>& trials) {
          return trials[i].grasps[g].draws[k].execution.stages > 0;
        };
        alike += held(a) == held(b) ? 1 : 0;
      }
    }
  }
  return 100.0 * alike / Executions(a);
}

}  // namespace

// Executions that end when nothing can change any more, beside phases simulated to their end; one
// object a call, 100 grasps of it five times, planning included.
void CompareTrials() {
  const std::vector<TriangleMesh> meshes = RemeshedCylinders(1);
  std::vector<PhysicsTrial> early, fixed, sink;
  const auto all = [&](int threads, Pace pace, std::vector<PhysicsTrial>* trials) {
    return [&meshes, threads, pace, trials] {
      PhysicsTrials tries(MetricOptions{}, {}, 7, threads, pace);
      trials->clear();
      std::uint64_t stream = 0;
      for (const TriangleMesh& mesh : meshes) trials->push_back(tries.Try(mesh, stream++));
    };
  };
  const std::vector<double> seconds = MedianSeconds({{"early", all(1, Pace::kEarly, &early)},
                                                     {"fixed", all(1, Pace::kFixed, &fixed)},
                                                     {"two threads", all(2, Pace::kEarly, &sink)}},
                                                    3);
  const double executions = Executions(early);
  std::printf("trials: %.0f executions a second on one core, %.0f with fixed phases\n",
              executions / seconds[0], executions / seconds[1]);
  std::printf("trials: %.1f %% of the outcomes alike\n", Alike(early, fixed));
  PrintRatio("trials_early_vs_fixed_phases", seconds[1] / seconds[0]);
  PrintRatio("trials_two_threads_vs_one", seconds[0] / seconds[2]);
}

}  // namespace antigrasp::bench
