#include "antigrasp/trial/trial_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace antigrasp {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::size_t> ByQuality(const PhysicsTrial& trial) {
  std::vector<std::size_t> order(trial.grasps.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return trial.grasps[a].planned.quality > trial.grasps[b].planned.quality;
  });
  return order;
}

double ShareHeld(const PhysicsTrial& trial, const std::vector<std::size_t>& grasps) {
  int held = 0, all = 0;
  for (const std::size_t i : grasps) {
    for (const ExecutedDraw& draw : trial.grasps[i].draws) {
      ++all;
      held += draw.execution.stages > 0 ? 1 : 0;
    }
  }
  return all > 0 ? static_cast<double>(held) / all : kNan;
}

// Executions that passed a stage, a number for every group that shares a plan: a grasp, or a series
// of grasps; those not found count as groups that passed nothing.
Share HeldThrough(const PhysicsTrial& trial, const Protocol& protocol, std::size_t stage) {
  const bool series = protocol.choice == GraspChoice::kBestUnused;
  const std::size_t each = trial.grasps.front().draws.size();
  std::vector<int> passed;
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
  for (const ExecutedGrasp& grasp : trial.grasps) {
    if (!series || grasp.series != last) passed.push_back(0);
    last = grasp.series;
    for (const ExecutedDraw& draw : grasp.draws) {
      passed.back() += std::cmp_greater(draw.execution.stages, stage) ? 1 : 0;
    }
  }
  if (!series) return ShareOfSeries(passed, static_cast<int>(each));
  const std::size_t count = trial.grasps.back().series + 1;
  passed.resize(std::max(passed.size(), count), 0);
  const auto in_series = static_cast<std::size_t>(trial.wanted) / count;
  return ShareOfSeries(passed, static_cast<int>(in_series * each));
}

}  // namespace

std::vector<std::size_t> GraspsOf(const PhysicsTrial& trial, GraspGroup group) {
  std::vector<std::size_t> order = ByQuality(trial);
  const std::size_t count = order.size();
  if (count == 0 || group == GraspGroup::kAll) return order;
  const auto rank = [&](double share) {
    return static_cast<std::size_t>(std::floor(share * static_cast<double>(count)));
  };
  std::size_t first = 0, last = 1;
  if (group == GraspGroup::kTopQuarter) last = rank(0.25);
  if (group == GraspGroup::kPercentile) first = rank(0.2), last = rank(0.3);
  last = std::max(last, first + 1);
  return {order.begin() + static_cast<std::ptrdiff_t>(first),
          order.begin() + static_cast<std::ptrdiff_t>(std::min(last, count))};
}

double TrialSummary::Kept() const {
  return candidates > 0 ? static_cast<double>(grasps) / candidates : kNan;
}

bool TrialSummary::HasShare() const { return !std::isnan(held.front().value); }

TrialSummary NotTried(const std::string& object, const std::string& status,
                      const Protocol& protocol) {
  TrialSummary summary;
  summary.object = object;
  summary.status = status;
  summary.mass = summary.predicted = summary.quality = kNan;
  summary.held.assign(protocol.stages.size(), {kNan, {kNan, kNan}});
  summary.group.fill(kNan);
  return summary;
}

TrialSummary SummaryOf(const std::string& object, const PhysicsTrial& trial,
                       const Protocol& protocol) {
  if (!trial.tried) return NotTried(object, "no stable pose", protocol);
  TrialSummary summary = NotTried(object, "ok", protocol);
  summary.mass = trial.mass;
  summary.poses = trial.poses;
  summary.wanted = trial.wanted;
  summary.candidates = trial.candidates;
  summary.grasps = static_cast<int>(trial.grasps.size());
  if (trial.grasps.empty()) {
    summary.status = "no reachable grasp";
    if (protocol.choice == GraspChoice::kBestUnused) {
      summary.held.assign(protocol.stages.size(), {0.0, {0.0, 0.0}});
    }
    return summary;
  }
  double predicted = 0.0, quality = 0.0;
  for (const ExecutedGrasp& grasp : trial.grasps) {
    quality += grasp.planned.quality;
    for (const ExecutedDraw& draw : grasp.draws) {
      ++summary.executions;
      ++summary.outcomes[static_cast<std::size_t>(draw.execution.outcome)];
      summary.untrusted += draw.execution.Trusted() ? 0 : 1;
      predicted += draw.predicted > 0.0 ? 1.0 : 0.0;
    }
  }
  summary.predicted = predicted / summary.executions;
  summary.quality = quality / summary.grasps;
  for (std::size_t stage = 0; stage < protocol.stages.size(); ++stage) {
    summary.held[stage] = HeldThrough(trial, protocol, stage);
  }
  for (std::size_t group = 0; group < kGraspGroups; ++group) {
    summary.group[group] = ShareHeld(trial, GraspsOf(trial, static_cast<GraspGroup>(group)));
  }
  return summary;
}

MeanInterval HeldOver(const std::vector<TrialSummary>& objects, std::size_t stage) {
  std::vector<double> held;
  for (const TrialSummary& object : objects) held.push_back(100.0 * object.held[stage].value);
  return MeanWithInterval(held);
}

MeanInterval DifferenceOver(const std::vector<TrialSummary>& after,
                            const std::vector<TrialSummary>& before, std::size_t stage) {
  std::vector<double> difference;
  for (std::size_t i = 0; i < after.size(); ++i) {
    difference.push_back(100.0 * (after[i].held[stage].value - before[i].held[stage].value));
  }
  return MeanWithInterval(difference);
}

}  // namespace antigrasp
