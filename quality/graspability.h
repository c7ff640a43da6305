#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/grasp_model.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/quality/rejected_grasps.h"

namespace antigrasp {

struct ScoredGrasp {
  Grasp grasp;                  // object frame after rescaling, metres
  double quality = 0.0;         // robust quality: mean over the draws (paper III-B: of epsilon)
  int draws = 0;                // num_draws, or fewer when adaptive
  std::uint64_t candidate = 0;  // which of those tried: the number of its draws
};

enum class GraspabilityStatus {
  kOk,
  kFewGrasps,    // fewer than num_grasps found within max_attempts: scored on what was found
  kNoGrasps,     // none: graspability 0, and counted
  kNotEvaluable  // empty, non-finite or zero-extent mesh: graspability NaN
};
std::string_view Name(GraspabilityStatus status);

// The graspability of one object: lower = harder to grasp.
struct Graspability {
  GraspabilityStatus status = GraspabilityStatus::kNotEvaluable;
  double value = 0.0;   // discrete percentile of the robust qualities, or their mean
  double ci_low = 0.0;  // 95 % interval over grasps: exact bootstrap; of the mean, normal
  double ci_high = 0.0;
  double mean = 0.0;              // mean robust quality
  double fraction_nonzero = 0.0;  // share of grasps with quality > 0
  int attempts = 0;               // candidates tried
  RejectedGrasps rejected;        // the others
  double scale = 1.0;             // metres per mesh unit (object_size.h)
  double seconds = 0.0;           // wall time; not deterministic
  std::vector<ScoredGrasp> grasps;
};

// Equation of III-B: samples antipodal grasps uniformly over the surface, keeps those that the
// gripper reaches, estimates each one's expected epsilon over draws of object pose, grasp pose and
// friction, takes the percentile. The random numbers depend on (seed, object) only: equal draws for
// an object and its changed version when `object` is equal. 5-20 ms for 2,500 faces, one thread.
Graspability EvaluateGraspability(const TriangleMesh& mesh, const MetricOptions& options,
                                  std::uint64_t seed, std::uint64_t object);

// The seed of a second scoring under fresh draws, for objects that were chosen by their scores
// under `seed`: the lowest of many noisy scores is too low, the second one is not.
std::uint64_t FreshSeed(std::uint64_t seed);

// The same with grasps of another model in place of ParallelJaws.
Graspability EvaluateGraspability(const TriangleMesh& mesh, const MetricOptions& options,
                                  std::uint64_t seed, std::uint64_t object,
                                  const MakeGraspModel& make);

// Of object i of a range. The mesh is asked for once, on the thread that scores it, and may be made
// or read then; nullptr: the object is not scored.
using MeshOfObject = std::function<const TriangleMesh*(std::int64_t)>;
using StreamOfObject = std::function<std::uint64_t(std::int64_t)>;  // number of its random stream

// EvaluateGraspability of the objects 0 to count - 1; kNotEvaluable for those without a mesh. Same
// values for any number of threads (0 = all).
std::vector<Graspability> ScoreAll(std::int64_t count, const MeshOfObject& mesh,
                                   const StreamOfObject& stream, const MetricOptions& options,
                                   std::uint64_t seed, int threads,
                                   const ProgressFn& progress = nullptr);

}  // namespace antigrasp
