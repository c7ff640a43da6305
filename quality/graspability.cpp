#include "antigrasp/quality/graspability.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>

#include "antigrasp/core/rng.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/adaptive_draws.h"
#include "antigrasp/quality/local_object.h"
#include "antigrasp/quality/parallel_jaws.h"

namespace antigrasp {
namespace {

bool IsCopy(const Grasp& grasp, const std::vector<NoisyGrasp>& kept, double separation) {
  return std::any_of(kept.begin(), kept.end(), [&](const NoisyGrasp& other) {
    return SameGrasp(grasp, other.grasp, separation);
  });
}

// Samples grasps until enough are found. A candidate's noise belongs to its number among the
// candidates, so that the same candidate meets the same noise on a changed object.
std::vector<NoisyGrasp> SampleGrasps(const GraspModel& model, const MetricOptions& options,
                                     std::uint64_t seed, std::uint64_t object,
                                     Graspability* result) {
  for (std::string& name : model.Reasons()) result->rejected.reasons.push_back({std::move(name)});
  std::vector<NoisyGrasp> kept;
  while (result->attempts < options.max_attempts &&
         static_cast<int>(kept.size()) < options.num_grasps) {
    const auto candidate = static_cast<std::uint64_t>(result->attempts++);
    RngStream grasp_rng(seed, "grasp", object, candidate);
    std::size_t why = 0;
    auto grasp = model.Candidate(&grasp_rng, &why);
    if (grasp && IsCopy(*grasp, kept, options.grasp_separation)) {
      ++result->rejected.copies;
    } else if (grasp && model.Reach(&*grasp, &why)) {
      kept.push_back({*grasp, RngStream(seed, "noise", object, candidate), candidate});
    } else {
      ++result->rejected.reasons.at(why).count;
    }
  }
  return kept;
}

void SampleAndScore(const TriangleMesh& mesh, const MakeGraspModel& make,
                    const MetricOptions& options, std::uint64_t seed, std::uint64_t object,
                    Graspability* result) {
  const RayScene scene(mesh);
  const auto model = make({mesh, scene, CenterOfMass(mesh)}, options);
  if (model == nullptr) return;
  std::vector<NoisyGrasp> grasps = SampleGrasps(*model, options, seed, object, result);
  Draw(*model, options, &grasps);
  for (const NoisyGrasp& noisy : grasps) {
    result->grasps.push_back({noisy.grasp, noisy.Mean(), noisy.draws, noisy.candidate});
  }
}

void SummarizeGrasps(const MetricOptions& options, Graspability* result) {
  std::vector<double> qualities;
  double sum = 0.0;
  int nonzero = 0;
  for (const ScoredGrasp& scored : result->grasps) {
    qualities.push_back(scored.quality);
    sum += scored.quality;
    nonzero += scored.quality > 0.0 ? 1 : 0;
  }
  const auto count = static_cast<double>(qualities.size());
  result->mean = sum / count;
  result->fraction_nonzero = nonzero / count;
  if (options.summary == Summary::kMean) {
    result->value = result->mean;
    if (options.closing == ClosingEnd::kSettled) {  // a share
      const Interval share = WilsonInterval(result->mean, count);
      result->ci_low = share.low;
      result->ci_high = share.high;
      return;
    }
    const MeanInterval mean = MeanWithInterval(qualities);
    const double half = mean.count > 1 ? mean.half_width : 0.0;
    result->ci_low = result->mean - half;
    result->ci_high = result->mean + half;
    return;
  }
  result->value = DiscretePercentile(qualities, options.percentile);
  const Interval interval = BootstrapPercentile(qualities, options.percentile);
  result->ci_low = interval.low;
  result->ci_high = interval.high;
}

void Move(const Eigen::Vector3d& by, Grasp* grasp) {
  grasp->center += by;
  for (Contact& contact : grasp->contacts) contact.point += by;
}

Graspability NotEvaluable() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Graspability result;
  result.value = result.ci_low = result.ci_high = result.mean = result.fraction_nonzero = kNan;
  return result;
}

Graspability Evaluate(const TriangleMesh& mesh, const MakeGraspModel& make,
                      const MetricOptions& options, std::uint64_t seed, std::uint64_t object) {
  const std::optional<LocalObject> local = MakeLocalObject(mesh, options);
  if (!local) return NotEvaluable();
  Graspability result;
  result.scale = local->scale;
  SampleAndScore(local->mesh, make, options, seed, object, &result);
  if (!local->place.isZero(0.0)) {
    const Eigen::Vector3d by = local->scale * local->place;
    for (ScoredGrasp& scored : result.grasps) Move(by, &scored.grasp);
  }
  if (result.grasps.empty()) {
    result.status = GraspabilityStatus::kNoGrasps;
    return result;
  }
  result.status = static_cast<int>(result.grasps.size()) < options.num_grasps
                      ? GraspabilityStatus::kFewGrasps
                      : GraspabilityStatus::kOk;
  SummarizeGrasps(options, &result);
  return result;
}

}  // namespace

std::string_view Name(GraspabilityStatus status) {
  switch (status) {
    case GraspabilityStatus::kOk:
      return "ok";
    case GraspabilityStatus::kFewGrasps:
      return "few_grasps";
    case GraspabilityStatus::kNoGrasps:
      return "no_grasps";
    case GraspabilityStatus::kNotEvaluable:
      return "not_evaluable";
  }
  return "unknown";
}

Graspability EvaluateGraspability(const TriangleMesh& mesh, const MetricOptions& options,
                                  std::uint64_t seed, std::uint64_t object,
                                  const MakeGraspModel& make) {
  const auto start = std::chrono::steady_clock::now();
  Graspability result = Evaluate(mesh, make, options, seed, object);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Graspability EvaluateGraspability(const TriangleMesh& mesh, const MetricOptions& options,
                                  std::uint64_t seed, std::uint64_t object) {
  return EvaluateGraspability(mesh, options, seed, object, &ParallelJaws);
}

std::uint64_t FreshSeed(std::uint64_t seed) { return RngStream(seed, "rescore").NextU64(); }

std::vector<Graspability> ScoreAll(std::int64_t count, const MeshOfObject& mesh,
                                   const StreamOfObject& stream, const MetricOptions& options,
                                   std::uint64_t seed, int threads, const ProgressFn& progress) {
  std::vector<Graspability> scores(static_cast<std::size_t>(count), NotEvaluable());
  ParallelFor(
      count, threads,
      [&](std::int64_t i) {
        const TriangleMesh* const object = mesh(i);
        if (object == nullptr) return;
        scores[static_cast<std::size_t>(i)] =
            EvaluateGraspability(*object, options, seed, stream(i));
      },
      progress);
  return scores;
}

}  // namespace antigrasp
