#include "antigrasp/trial/model_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/force_closure.h"
#include "antigrasp/quality/jaw_closing.h"
#include "antigrasp/quality/robust_quality.h"
#include "antigrasp/trial/trial_table.h"

namespace antigrasp {
namespace {

// What one series came to.
struct Series {
  int found = 0, holds_planned = 0;
  int force_closure = 0, held = 0;  // executions
  double confidence = 0.0;          // sum
};

struct Hold {
  bool force_closure = false;
  bool epsilon = false;  // force closure and epsilon above the limit
};

Hold Holds(const TrialTable& table, const MetricOptions& metric, double min_epsilon,
           const Grasp& grasp, const NoiseDraw& noise) {
  const JawPose pose = ExecutedPose(grasp, table.com(), noise);
  const auto contacts =
      CloseJaws(table.scene(), pose.center, pose.axis, metric.jaw_opening, noise.friction);
  if (!contacts || !ForceClosure(*contacts, noise.friction, NormalSense::kOutward)) return {};
  return {true,
          Epsilon(*contacts, table.com(), WrenchModelOf(metric, noise.friction)) > min_epsilon};
}

Series RunSeries(const TrialTable& table, const MetricOptions& metric, const TrialOptions& options,
                 const TrialPlan& plan) {
  Series series;
  for (const TrialGrasp& planned : plan.grasps) {
    ++series.found;
    series.confidence += planned.quality;
    NoiseDraw as_planned;
    as_planned.friction = metric.friction;
    series.holds_planned +=
        Holds(table, metric, options.min_epsilon, planned.grasp, as_planned).epsilon ? 1 : 0;
    for (const NoiseDraw& noise : planned.draws) {
      const Hold hold = Holds(table, metric, options.min_epsilon, planned.grasp, noise);
      series.force_closure += hold.force_closure ? 1 : 0;
      series.held += hold.epsilon ? 1 : 0;
    }
  }
  return series;
}

TrialResult SummarizeSeries(const TrialTable* table, const Series* first,
                            const TrialOptions& options) {
  TrialResult result;
  result.grasps = options.series * options.grasps_per_series;
  if (table == nullptr) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    result.confidence = kNan;
    result.force_closure = result.held = {kNan, {kNan, kNan}};
    return result;
  }
  result.poses = static_cast<int>(table->poses().size());
  std::vector<int> force_closure, held;
  for (const Series* series = first; series != first + options.series; ++series) {
    result.found += series->found;
    result.holds_planned += series->holds_planned;
    result.confidence += series->confidence;
    force_closure.push_back(series->force_closure);
    held.push_back(series->held);
  }
  result.confidence = result.found > 0 ? result.confidence / result.found : 0.0;
  const int each = options.grasps_per_series * options.executions;
  result.force_closure = ShareOfSeries(force_closure, each);
  result.held = ShareOfSeries(held, each);
  return result;
}

}  // namespace

double FrictionCoefficient(double angle_degrees, FrictionReading reading) {
  const double half = reading == FrictionReading::kHalfAngle ? angle_degrees : 0.5 * angle_degrees;
  return std::tan(half * std::numbers::pi / 180.0);
}

void Bind(OptionTable* table, TrialOptions* options) {
  TrialOptions& o = *options;
  table->Add("trial.series", &o.series, 1, 1e6, "repetitions, each with a new plan");
  table->Add("trial.grasps_per_series", &o.grasps_per_series, 1, 1e6,
             "grasps per repetition, each in a stable pose drawn by its probability");
  table->Add("trial.executions", &o.executions, 1, 1e6, "executions of each grasp, fresh noise");
  table->Add("trial.min_epsilon", &o.min_epsilon, 0.0, 1e9, "a grasp holds above this epsilon");
  table->Add("trial.approach_cone", &o.table.approach_cone, 0.0, 180.0,
             "widest angle between the way in and straight down, degrees");
  table->Add("trial.table_clearance", &o.table.clearance, 0.0, 100.0,
             "lowest height of the gripper above the table, m");
}

Share ShareOfSeries(const std::vector<int>& held, int each) {
  const auto series = static_cast<double>(held.size());
  const double executions = series * each;
  Share share;
  share.value = std::accumulate(held.begin(), held.end(), 0.0) / executions;
  double squares = 0.0;
  for (const int count : held) {
    const double off = static_cast<double>(count) / each - share.value;
    squares += off * off;
  }
  const double variance = squares / (std::max(series - 1.0, 1.0) * series);  // of the mean
  const double worth = variance > 0.0 ? share.value * (1.0 - share.value) / variance : series;
  share.interval = WilsonInterval(share.value, std::clamp(worth, series, executions));
  return share;
}

std::vector<TrialResult> RunTrials(const std::vector<TriangleMesh>& meshes,
                                   const MetricOptions& metric, const TrialOptions& options,
                                   std::uint64_t seed, int threads, const ProgressFn& progress,
                                   const std::vector<std::uint64_t>& streams) {
  std::vector<std::unique_ptr<const TrialTable>> tables(meshes.size());
  ParallelFor(std::ssize(meshes), threads, [&](std::int64_t i) {
    tables[static_cast<std::size_t>(i)] =
        MakeTrialTable(meshes[static_cast<std::size_t>(i)], metric, options.table);
  });
  std::vector<Series> series(meshes.size() * static_cast<std::size_t>(options.series));
  ParallelFor(
      std::ssize(series), threads,
      [&](std::int64_t i) {
        const auto object = static_cast<std::size_t>(i / options.series);
        if (tables[object] == nullptr) return;
        const TrialPlan plan =
            tables[object]->BestUnused(seed, streams.empty() ? object : streams[object],
                                       static_cast<std::uint64_t>(i % options.series),
                                       options.grasps_per_series, options.executions);
        series[static_cast<std::size_t>(i)] = RunSeries(*tables[object], metric, options, plan);
      },
      progress);
  std::vector<TrialResult> results;
  for (std::size_t object = 0; object < meshes.size(); ++object) {
    results.push_back(SummarizeSeries(
        tables[object].get(), &series[object * static_cast<std::size_t>(options.series)], options));
  }
  return results;
}

}  // namespace antigrasp
