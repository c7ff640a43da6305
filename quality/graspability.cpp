#include "antigrasp/quality/graspability.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "antigrasp/core/rng.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/adaptive_draws.h"
#include "antigrasp/quality/antipodal_sampler.h"
#include "antigrasp/quality/reachability.h"
#include "antigrasp/quality/robust_quality.h"

namespace antigrasp {
namespace {

bool IndicesInRange(const TriangleMesh& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  return std::all_of(mesh.faces.begin(), mesh.faces.end(), [count](const auto& face) {
    return std::all_of(face.begin(), face.end(),
                       [count](std::int32_t v) { return v >= 0 && v < count; });
  });
}

bool Finite(const TriangleMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Eigen::Vector3d& v) { return v.allFinite(); });
}

// The factor that brings the smallest extent to options.object_min_extent; 0 when the mesh has no
// usable size.
double ScaleToMetres(const TriangleMesh& mesh, const MetricOptions& options) {
  if (mesh.faces.empty() || !IndicesInRange(mesh) || !Finite(mesh)) return 0.0;
  const Eigen::Vector3d extent = Bounds(mesh).Extent();
  const double smallest = extent.minCoeff();
  const double scale = options.object_min_extent > 0.0 ? options.object_min_extent / smallest : 1.0;
  // The ray tree holds floats: sizes beyond their range cannot be evaluated.
  const bool usable = smallest > 0.0 && std::isfinite(scale) && extent.maxCoeff() * scale < 1e18;
  return usable ? scale : 0.0;
}

void Count(GraspRejection why, RejectedGrasps* rejected) {
  switch (why) {
    case GraspRejection::kNoOpposite:
      ++rejected->no_opposite;
      break;
    case GraspRejection::kSlips:
      ++rejected->slips;
      break;
    case GraspRejection::kJawBlocked:
      ++rejected->jaw_blocked;
      break;
  }
}

// Finds the gripper's way in to the grasp; false when every one collides. Without a gripper nothing
// is looked for.
bool FindApproach(const std::optional<GripperCollision>& gripper, double opening, Grasp* grasp) {
  if (!gripper) return true;
  const auto approach = gripper->FreeApproach(*grasp, opening);
  if (approach) grasp->approach = *approach;
  return approach.has_value();
}

// Two grasps are one when their contacts coincide, whichever jaw holds which.
bool SameGrasp(const Grasp& a, const Grasp& b, double separation) {
  const auto near = [&](std::size_t i, std::size_t j) {
    return (a.contacts[i].point - b.contacts[j].point).norm() < separation;
  };
  return (near(0, 0) && near(1, 1)) || (near(0, 1) && near(1, 0));
}

bool IsCopy(const Grasp& grasp, const std::vector<NoisyGrasp>& kept, double separation) {
  return std::any_of(kept.begin(), kept.end(), [&](const NoisyGrasp& other) {
    return SameGrasp(grasp, other.grasp, separation);
  });
}

// Samples grasps until enough are found. A candidate's noise belongs to its number among the
// candidates, so that the same candidate meets the same noise on a changed object.
std::vector<NoisyGrasp> SampleGrasps(const TriangleMesh& mesh, const RayScene& scene,
                                     const MetricOptions& options, std::uint64_t seed,
                                     std::uint64_t object, Graspability* result) {
  std::vector<NoisyGrasp> kept;
  const AntipodalSampler sampler(mesh, scene, options.friction, options.jaw_opening);
  if (!(sampler.area() > 0.0)) return kept;
  std::optional<GripperCollision> gripper;
  if (options.collision == "gripper") gripper.emplace(mesh, scene, options.gripper);
  while (result->attempts < options.max_attempts &&
         static_cast<int>(kept.size()) < options.num_grasps) {
    const auto candidate = static_cast<std::uint64_t>(result->attempts++);
    RngStream grasp_rng(seed, "grasp", object, candidate);
    GraspRejection why{};
    auto grasp = sampler.Try(&grasp_rng, &why);
    if (!grasp) {
      Count(why, &result->rejected);
    } else if (IsCopy(*grasp, kept, options.grasp_separation)) {
      ++result->rejected.copies;
    } else if (!FindApproach(gripper, options.jaw_opening, &*grasp)) {
      ++result->rejected.gripper_collides;
    } else {
      kept.push_back({*grasp, RngStream(seed, "noise", object, candidate)});
    }
  }
  return kept;
}

void SampleAndScore(const TriangleMesh& mesh, const MetricOptions& options, std::uint64_t seed,
                    std::uint64_t object, Graspability* result) {
  const RayScene scene(mesh);
  std::vector<NoisyGrasp> grasps = SampleGrasps(mesh, scene, options, seed, object, result);
  const Eigen::Vector3d com = CenterOfMass(mesh);
  if (options.adaptive) {
    DrawAdaptively(scene, com, options, &grasps);
  } else {
    DrawAll(scene, com, options, &grasps);
  }
  for (const NoisyGrasp& noisy : grasps) {
    result->grasps.push_back({noisy.grasp, noisy.Mean(), noisy.draws});
  }
}

void Summarise(const MetricOptions& options, Graspability* result) {
  std::vector<double> qualities;
  double sum = 0.0;
  int nonzero = 0;
  for (const ScoredGrasp& scored : result->grasps) {
    qualities.push_back(scored.quality);
    sum += scored.quality;
    nonzero += scored.quality > 0.0 ? 1 : 0;
  }
  const auto count = static_cast<double>(qualities.size());
  result->value = DiscretePercentile(qualities, options.percentile);
  result->mean = sum / count;
  result->fraction_nonzero = nonzero / count;
  const Interval interval = BootstrapPercentile(qualities, options.percentile);
  result->ci_low = interval.low;
  result->ci_high = interval.high;
}

Graspability NotEvaluable() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Graspability result;
  result.value = result.ci_low = result.ci_high = result.mean = result.fraction_nonzero = kNan;
  return result;
}

Graspability Evaluate(const TriangleMesh& mesh, const MetricOptions& options, std::uint64_t seed,
                      std::uint64_t object) {
  const double scale = ScaleToMetres(mesh, options);
  if (!(scale > 0.0)) return NotEvaluable();
  Graspability result;
  result.scale = scale;
  SampleAndScore(Transformed(mesh, scale, Eigen::Vector3d::Zero()), options, seed, object, &result);
  if (result.grasps.empty()) {
    result.status = GraspabilityStatus::kNoGrasps;
    return result;
  }
  result.status = static_cast<int>(result.grasps.size()) < options.num_grasps
                      ? GraspabilityStatus::kFewGrasps
                      : GraspabilityStatus::kOk;
  Summarise(options, &result);
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
                                  std::uint64_t seed, std::uint64_t object) {
  const auto start = std::chrono::steady_clock::now();
  Graspability result = Evaluate(mesh, options, seed, object);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

std::vector<Graspability> EvaluateAll(const std::vector<TriangleMesh>& meshes,
                                      const MetricOptions& options, std::uint64_t seed,
                                      std::uint64_t first_object, int threads,
                                      const ProgressFn& progress) {
  std::vector<Graspability> results(meshes.size());
  ParallelFor(
      static_cast<std::int64_t>(meshes.size()), threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        results[slot] = EvaluateGraspability(meshes[slot], options, seed, first_object + slot);
      },
      progress);
  return results;
}

}  // namespace antigrasp
