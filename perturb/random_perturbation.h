#pragma once

#include <array>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/cone.h"
#include "antigrasp/perturb/pair_sampler.h"
#include "antigrasp/perturb/perturbation.h"

namespace antigrasp {

// From which normals a face may deviate: the original's, or those before each step.
enum class NormalLimit { kOriginal, kStep };
constexpr auto ChoicesOf(NormalLimit) {
  return std::to_array<Choice<NormalLimit>>(
      {{NormalLimit::kOriginal, "original"}, {NormalLimit::kStep, "step"}});
}

// Which of the six steps is taken.
enum class StepRule {
  kSmallest,        // the shortest of those that raise the angle at all (delta in R+)
  kSmallestOrNone,  // the same, but a direction without gain counts as delta = 0: no move
  kLargestAngle,    // the one that ends with the largest angle
  kLargest          // the longest
};
constexpr auto ChoicesOf(StepRule) {
  return std::to_array<Choice<StepRule>>({{StepRule::kSmallest, "smallest"},
                                          {StepRule::kSmallestOrNone, "smallest_or_none"},
                                          {StepRule::kLargestAngle, "largest_angle"},
                                          {StepRule::kLargest, "largest"}});
}

// Section IV-B. In each iteration: a pair of antipodal faces, one of its corners, six random
// directions; along each the step that makes the pair's antipodality angle largest while no face
// around the corner deviates by more than alpha; one of these steps is taken.
struct RandomPerturbOptions {
  double alpha = 10.0;  // degrees
  NormalLimit limit = NormalLimit::kOriginal;
  StepRule step = StepRule::kSmallest;
  PairDraw pairs = PairDraw::kRay;
  int directions = 6;
  int iterations = 0;  // 0 = iterations_per_vertex times the number of vertices
  double iterations_per_vertex = 8.0;
  double max_step = 2.0;  // longest step, mean edge lengths
};
void Bind(OptionTable* table, RandomPerturbOptions* options);  // keys "random.*"

// Single thread. The result depends on the mesh, the options and the stream only. 10,000 iterations
// on 2,500 faces take 0.2 s. The mesh must be a solid (failure otherwise, and nothing is moved).
PerturbResult PerturbRandomly(const TriangleMesh& mesh, const PairLimits& pairs,
                              const PerturbOptions& common, const RandomPerturbOptions& options,
                              RngStream* rng, const ProgressFn& progress = nullptr);

// Along `direction` from where the vertex is: the steps within `within` under which every face
// around it stays within `angle` (radians) of its start normal or, with `from_start` false, of the
// one it has now. A face's normal before normalising moves along a line and the allowed normals
// fill a cone, so the answer is one range, and exact (cone.h).
Range AllowedSteps(const EditableMesh& mesh, std::int32_t vertex, const Eigen::Vector3d& direction,
                   double angle, bool from_start, Range within);

// The step in `within` that makes the antipodality angle of the two faces largest, and that angle.
// Closed form unless both faces hold the vertex, then a fine search.
struct Step {
  double length = 0.0;
  double angle = 0.0;
};
Step BestStep(const EditableMesh& mesh, std::int32_t first, std::int32_t second,
              std::int32_t vertex, const Eigen::Vector3d& direction, Range within);

}  // namespace antigrasp
