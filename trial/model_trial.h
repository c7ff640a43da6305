#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/quality/table_reach.h"

// The physical experiment of the paper (VII-B, Table I) without the robot: how often the planner's
// best grasps hold.
namespace antigrasp {

// What a friction angle means: the cone's half angle (of repose, mu = tan angle), or the opening of
// the whole cone (mu = tan(angle / 2)). Faces under the antipodality angle phi can be pinched as
// long as phi <= 2 angle, or phi <= angle.
enum class FrictionReading { kHalfAngle, kFullCone };
constexpr auto ChoicesOf(FrictionReading) {
  return std::to_array<Choice<FrictionReading>>(
      {{FrictionReading::kHalfAngle, "half-angle"}, {FrictionReading::kFullCone, "full-cone"}});
}
double FrictionCoefficient(double angle_degrees, FrictionReading reading);

struct TrialOptions {
  int series = 100;
  int grasps_per_series = 5;   // the paper's
  int executions = 3;          // of each grasp, with fresh noise each time; the paper's
  double min_epsilon = 0.002;  // a grasp holds above this: Dex-Net 2.0's limit of a robust grasp
  TableOptions table;
};
void Bind(OptionTable* table, TrialOptions* options);  // keys "trial.*"

// A share and its 95 % interval.
struct Share {
  double value = 0.0;
  Interval interval;
};
// The share of `each` * held.size() executions that held; held[i] counts those of series i, which
// share a plan. Wilson's score interval for as many independent executions as the spread between
// the series is worth; for as many as there are series where they do not differ at all.
Share ShareOfSeries(const std::vector<int>& held, int each);

struct TrialResult {
  int poses = 0;            // stable poses; 0 = the object cannot be tried, all shares are NaN
  int grasps = 0;           // asked for: series * grasps_per_series
  int found = 0;            // for these there was a reachable grasp left
  int holds_planned = 0;    // these hold without noise (force closure and epsilon > min_epsilon)
  double confidence = 0.0;  // mean robust quality of those found
  Share force_closure;      // of all executions, those held by force closure; no grasp: not held
  Share held;               // the same, and epsilon > min_epsilon
};

// For every mesh `series` times: plan anew (metric.num_grasps antipodal grasps with their robust
// quality); then grasps_per_series times draw a stable pose by its probability, take the grasp of
// highest robust quality that is reachable in it and was not yet executed in this series, and
// execute it under fresh noise. It is in force closure when both jaws touch first from outside and
// the line between the contacts lies in both friction cones, at the friction drawn.
//
// Object i draws from the streams of number streams[i], or of i without `streams`: equal for any
// number of threads. 100 series on 20 faces take about 0.4 s on one thread.
std::vector<TrialResult> RunTrials(const std::vector<TriangleMesh>& meshes,
                                   const MetricOptions& metric, const TrialOptions& options,
                                   std::uint64_t seed, int threads = 0,
                                   const ProgressFn& progress = nullptr,
                                   const std::vector<std::uint64_t>& streams = {});

}  // namespace antigrasp
