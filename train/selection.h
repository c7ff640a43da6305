#pragma once

#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/train/prior_spread.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// What the next episode trains on: samples of this one and shapes of the prior set, by index.
struct Selection {
  std::vector<std::int64_t> elites;    // ascending
  std::vector<std::int64_t> replayed;  // prior shapes
  std::int64_t outside = 0;            // usable samples beyond cem.spread
};

// A shape that is harder to grasp than `mesh`, looks like it and lies within the box; the mesh
// itself where none is found. Unit cube coordinates; `seed` names the random stream; called on any
// thread.
using MeshRefiner = std::function<TriangleMesh(const TriangleMesh& mesh, const RunConfig& config,
                                               const BoundingBox& within, std::uint64_t seed)>;

// The elites of an episode by a MeshRefiner, each with its own seed, in their order.
struct RoughElite {
  TriangleMesh mesh;
  std::uint64_t seed = 0;
};
using EliteRefiner = std::function<std::vector<TriangleMesh>(
    const std::vector<RoughElite>& elites, const RunConfig& config, const BoundingBox& within,
    const ProgressFn& progress)>;
EliteRefiner InThreads(MeshRefiner refine);  // of this process

// Picks elites by the rules of cem.variant:
//   kPaper        the cem.keep least graspable of all samples (V-B, VI-C).
//   kStratified   the prior set is cut into cem.cells cells (a shape belongs to the nearest of that
//                 many random prior shapes, by network values); each cell keeps the least graspable
//                 of the samples in it, as many as its share of the prior set, and prior shapes of
//                 the cell stand in for those that are missing. What the elites are like, to the
//                 grain of the cells, then stays what the prior is like: the similarity constraint
//                 D_KL(P_S || P_theta) of V-C, held by construction instead of by hope.
//   kDiverse      Dominated Novelty Search (elites.h) by network values: the least graspable, and
//                 those that are unlike their cem.neighbours nearest that are less graspable.
// In all, no sample beyond cem.spread of the prior set (prior_spread.h) is kept, cem.prior_fraction
// more shapes of the prior set are mixed in, and cem.select = kRandom puts chance in the place of
// graspability.
class EliteSelector {
 public:
  // prior: network values [N, ...]; refine: for cem.refine_steps, whose elites it changes.
  EliteSelector(const RunConfig& config, torch::Tensor prior, EliteRefiner refine = nullptr);
  Selection Select(const ScoredStage& scored, int episode) const;

  // `values` with empty grids in the place of those beyond a share of cem.spread, which then cost a
  // scorer nothing and have no score.
  torch::Tensor WithoutOutside(const torch::Tensor& values, double share) const;

  // Network values [K, 1, n, n, n] of the elites as they are learnt from: those that were sampled;
  // with cem.redistance those of the exact distances to their meshes, float16; with
  // cem.refine_steps those of the distances to their meshes as they were refined.
  torch::Tensor Elites(const ScoredStage& scored, const Selection& selection, int episode,
                       const ProgressFn& progress) const;

  // What the next episode trains on, float16: the elites, then the replayed shapes.
  torch::Tensor TrainingSet(const torch::Tensor& elites, const Selection& selection) const;

 private:
  torch::Tensor ExactValues(const ScoredStage& scored, const std::vector<std::int64_t>& indices,
                            int episode, const ProgressFn& progress) const;
  // NaN in the place of what is beyond cem.spread of `values`; how many that are.
  std::int64_t LeaveOutside(const torch::Tensor& values, std::vector<double>* order) const;

  const RunConfig& config_;
  torch::Tensor prior_;
  EliteRefiner refine_;
  std::optional<PriorSpread> spread_;
  torch::Tensor centres_;                             // [cells, r^3] float32
  std::vector<std::vector<std::int64_t>> residents_;  // of each cell: prior shapes
};

}  // namespace antigrasp
