#include "antigrasp/trial/model_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/place.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/force_closure.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/jaw_closing.h"
#include "antigrasp/quality/robust_quality.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

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

// An object that stands on a table in front of the gripper.
class Bench {
 public:
  Bench(const TriangleMesh& mesh, double scale, const MetricOptions& metric,
        const TrialOptions& options)
      : mesh_(Transformed(Transformed(mesh, 1.0, Vector3d::Zero() - RoundPlace(mesh)), scale,
                          Vector3d::Zero())),
        scene_(mesh_),
        com_(CenterOfMass(mesh_)),
        poses_(StablePoses(mesh_, com_)),
        reach_(mesh_, scene_, metric, options.table),
        metric_(metric),
        options_(options) {}

  int poses() const { return static_cast<int>(poses_.size()); }

  Series Run(std::uint64_t seed, std::uint64_t object, std::uint64_t number) const {
    const std::uint64_t plan_seed = RngStream(seed, "trial-plan", object, number).NextU64();
    RngStream rng(seed, "trial", object, number);
    std::vector<ScoredGrasp> left = Plan(plan_seed, object);
    Series series;
    for (int i = 0; i < options_.grasps_per_series; ++i) {
      const StablePose& pose = DrawPose(&rng);
      const auto best = std::find_if(left.begin(), left.end(), [&](const ScoredGrasp& scored) {
        return reach_.Approach(scored.grasp, pose).has_value();
      });
      if (best == left.end()) continue;
      Execute(best->grasp, &rng, &series);
      series.confidence += best->quality;
      left.erase(best);
    }
    return series;
  }

 private:
  // Grasps by falling robust quality.
  std::vector<ScoredGrasp> Plan(std::uint64_t seed, std::uint64_t object) const {
    MetricOptions in_metres = metric_;
    in_metres.object_min_extent = 0.0;
    in_metres.units = LengthUnit::kM;
    std::vector<ScoredGrasp> grasps = EvaluateGraspability(mesh_, in_metres, seed, object).grasps;
    std::stable_sort(grasps.begin(), grasps.end(), [](const ScoredGrasp& a, const ScoredGrasp& b) {
      return a.quality > b.quality;
    });
    return grasps;
  }

  const StablePose& DrawPose(RngStream* rng) const {
    double rest = rng->Uniform();
    for (const StablePose& pose : poses_) {
      rest -= pose.probability;
      if (rest < 0.0) return pose;
    }
    return poses_.back();  // rounding
  }

  void Execute(const Grasp& grasp, RngStream* rng, Series* series) const {
    ++series->found;
    NoiseDraw as_planned;
    as_planned.friction = metric_.friction;
    series->holds_planned += Holds(grasp, as_planned).epsilon ? 1 : 0;
    for (int i = 0; i < options_.executions; ++i) {
      const Hold hold = Holds(grasp, DrawNoise(metric_, rng));
      series->force_closure += hold.force_closure ? 1 : 0;
      series->held += hold.epsilon ? 1 : 0;
    }
  }

  Hold Holds(const Grasp& grasp, const NoiseDraw& noise) const {
    const JawPose pose = ExecutedPose(grasp, com_, noise);
    const auto contacts =
        CloseJaws(scene_, pose.center, pose.axis, metric_.jaw_opening, noise.friction);
    if (!contacts || !ForceClosure(*contacts, noise.friction, NormalSense::kOutward)) return {};
    const double epsilon = Epsilon(*contacts, com_, WrenchModelOf(metric_, noise.friction));
    return {true, epsilon > options_.min_epsilon};
  }

  TriangleMesh mesh_;
  RayScene scene_;
  Vector3d com_;
  std::vector<StablePose> poses_;
  TableReach reach_;
  MetricOptions metric_;
  TrialOptions options_;
};

// nullptr for an object that cannot be tried.
std::unique_ptr<const Bench> MakeBench(const TriangleMesh& mesh, const MetricOptions& metric,
                                       const TrialOptions& options) {
  MetricOptions one_candidate = metric;
  one_candidate.max_attempts = 1;
  const Graspability look = EvaluateGraspability(mesh, one_candidate, 0, 0);
  if (look.status == GraspabilityStatus::kNotEvaluable) return nullptr;
  auto bench = std::make_unique<const Bench>(mesh, look.scale, metric, options);
  return bench->poses() > 0 ? std::move(bench) : nullptr;
}

TrialResult SummarizeSeries(const Bench* bench, const Series* first, const TrialOptions& options) {
  TrialResult result;
  result.grasps = options.series * options.grasps_per_series;
  if (bench == nullptr) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    result.confidence = kNan;
    result.force_closure = result.held = {kNan, {kNan, kNan}};
    return result;
  }
  result.poses = bench->poses();
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

Interval Wilson(double share, double count) {
  constexpr double z = 1.959963984540054;
  const double middle = share + z * z / (2.0 * count);
  const double half = z * std::sqrt((share * (1.0 - share) + z * z / (4.0 * count)) / count);
  const double scale = 1.0 + z * z / count;
  return {std::max(0.0, (middle - half) / scale), std::min(1.0, (middle + half) / scale)};
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
  share.interval = Wilson(share.value, std::clamp(worth, series, executions));
  return share;
}

std::vector<TrialResult> RunTrials(const std::vector<TriangleMesh>& meshes,
                                   const MetricOptions& metric, const TrialOptions& options,
                                   std::uint64_t seed, int threads, const ProgressFn& progress,
                                   const std::vector<std::uint64_t>& streams) {
  std::vector<std::unique_ptr<const Bench>> benches(meshes.size());
  ParallelFor(std::ssize(meshes), threads, [&](std::int64_t i) {
    benches[static_cast<std::size_t>(i)] =
        MakeBench(meshes[static_cast<std::size_t>(i)], metric, options);
  });
  std::vector<Series> series(meshes.size() * static_cast<std::size_t>(options.series));
  ParallelFor(
      std::ssize(series), threads,
      [&](std::int64_t i) {
        const auto object = static_cast<std::size_t>(i / options.series);
        if (benches[object] == nullptr) return;
        series[static_cast<std::size_t>(i)] =
            benches[object]->Run(seed, streams.empty() ? object : streams[object],
                                 static_cast<std::uint64_t>(i % options.series));
      },
      progress);
  std::vector<TrialResult> results;
  for (std::size_t object = 0; object < meshes.size(); ++object) {
    results.push_back(SummarizeSeries(benches[object].get(),
                                      &series[object * static_cast<std::size_t>(options.series)],
                                      options));
  }
  return results;
}

}  // namespace antigrasp
