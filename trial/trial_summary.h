#pragma once

#include <array>
#include <string>
#include <vector>

#include "antigrasp/core/statistics.h"
#include "antigrasp/trial/physics_trial.h"

// What a trial comes to for one object, and for a set beside another.
namespace antigrasp {

// Which grasps of an object a share is about, by falling robust quality.
enum class GraspGroup { kAll, kBest, kTopQuarter, kPercentile };
constexpr auto ChoicesOf(GraspGroup) {
  return std::to_array<Choice<GraspGroup>>({{GraspGroup::kAll, "all"},
                                            {GraspGroup::kBest, "best"},
                                            {GraspGroup::kTopQuarter, "top quarter"},
                                            {GraspGroup::kPercentile, "75th percentile"}});
}
inline constexpr std::size_t kGraspGroups = 4;

// The grasps of a group, places in `trial.grasps`: all, the first, the best quarter, those from the
// 70th to the 80th percentile (at least one each). Where series are tried the best of each series.
std::vector<std::size_t> GraspsOf(const PhysicsTrial& trial, GraspGroup group);

struct TrialSummary {
  std::string object, status;  // "ok", "no stable pose", "no reachable grasp", or why not loaded
  double mass = 0.0;           // kg
  int poses = 0, wanted = 0, candidates = 0, grasps = 0, executions = 0;
  std::vector<Share> held;  // by stage of the protocol, all grasps; a grasp not found is not held
                            // in protocols that want a number of them
  std::array<double, kGraspGroups> group{};  // share held of a group's executions, first stage
  std::array<int, ChoicesOf(Outcome{}).size()> outcomes{};
  int untrusted = 0;       // executions with a penetration above 0.1 mm
  double predicted = 0.0;  // share of the executions in force closure by the metric
  double quality = 0.0;    // mean robust quality

  double Kept() const;  // share of the candidates that became grasps; NaN where none was tried
  // Whether a share was held of anything. Not of an object that no grasp reaches, whose success is
  // unknown, but for protocols that want a number of grasps: one that was not found is not held.
  bool HasShare() const;
};
TrialSummary SummaryOf(const std::string& object, const PhysicsTrial& trial,
                       const Protocol& protocol);
// Of an object that could not be loaded: no numbers.
TrialSummary NotTried(const std::string& object, const std::string& status,
                      const Protocol& protocol);

// Percent of the executions held by stage over objects, or the mean paired difference in points.
// Objects without a share are left out, and so are pairs in which one is.
MeanInterval HeldOver(const std::vector<TrialSummary>& objects, std::size_t stage);
MeanInterval DifferenceOver(const std::vector<TrialSummary>& after,
                            const std::vector<TrialSummary>& before, std::size_t stage);

}  // namespace antigrasp
