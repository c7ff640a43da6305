#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/judge_pool.h"
#include "antigrasp/perturb/mesh_change.h"
#include "antigrasp/perturb/perturbation.h"
#include "antigrasp/perturb/subdivide.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {

// One of the algorithms with its own options bound.
using PerturbMethod = std::function<PerturbResult(const TriangleMesh& mesh, const PairLimits& pairs,
                                                  const PerturbOptions& common, RngStream* rng,
                                                  const ProgressFn& progress)>;

// That of an algorithm and its options.
template <typename Run, typename Options>
PerturbMethod Bound(Run run, Options own) {
  return [run, own](const TriangleMesh& mesh, const PairLimits& pairs, const PerturbOptions& common,
                    RngStream* rng, const ProgressFn& progress) {
    return run(mesh, pairs, common, own, rng, progress);
  };
}

struct PerturbSettings {
  PerturbMethod method = {};
  SubdivideOptions subdivide = {};  // before everything else
  PerturbOptions common = {};
  MetricOptions metric = {};
  std::uint64_t seed = 1;
  std::shared_ptr<JudgePool> judges = {};  // also score before and after; nullptr: the metric alone
};

// An object before and after, with all that is reported about it. What does not exist (no result,
// no evaluable mesh) is NaN or -1.
struct ScoredPerturbation {
  TriangleMesh before;  // the input, subdivided, in single precision about its own place
  PerturbResult result;
  double graspability_before, graspability_after;  // under the same random numbers
  std::int64_t pairs_before = -1, pairs_after = -1;
  NormalDeviation normals;  // against result.start
  MeshChange change;        // against `before`
  std::string judge;        // who else scored, "" = nobody
  double judge_before, judge_after;
  double seconds = 0.0;  // of the algorithm alone, wall time
};

// Both meshes are scored and judged with the draws of stream `object`; the algorithm draws from the
// stream (seed, "perturb", object). Single thread. The algorithm's progress is passed on. Any mesh;
// what is no solid is returned with result.failure, and so is what no algorithm could move because
// it has too few vertices ("unchanged: ..."). Wherever it lies: all work is done at the origin
// (RoundPlace), and the meshes come back where the input is.
ScoredPerturbation PerturbAndScore(const TriangleMesh& mesh, const PerturbSettings& settings,
                                   std::uint64_t object, const ProgressFn& progress = nullptr);

// By how many percent the mean graspability, and with it kappa, falls from before to after, with
// its 95 % interval over objects (delta method for the ratio of two paired means). Pairs with a NaN
// are left out.
MeanInterval KappaReduction(const std::vector<double>& before, const std::vector<double>& after);

}  // namespace antigrasp
