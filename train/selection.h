#pragma once

#include <torch/types.h>

#include <cstdint>
#include <vector>

#include "antigrasp/train/run_config.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// What the next episode trains on: samples of this one and shapes of the prior set, by index.
struct Selection {
  std::vector<std::int64_t> elites;    // ascending
  std::vector<std::int64_t> replayed;  // prior shapes
};

// Picks elites by the rules of cem.variant:
//   kPaper        the cem.keep least graspable of all samples (V-B, VI-C).
//   kStratified   the prior set is cut into cem.cells cells (a shape belongs to the nearest of that
//                 many random prior shapes, by network values); each cell keeps the least graspable
//                 of the samples in it, as many as its share of the prior set, and prior shapes of
//                 the cell stand in for those that are missing. What the elites are like, to the
//                 grain of the cells, then stays what the prior is like: the similarity constraint
//                 D_KL(P_S || P_theta) of V-C, held by construction instead of by hope.
// In both, cem.prior_fraction more shapes of the prior set are mixed in, and cem.select = kRandom
// puts chance in the place of graspability.
class EliteSelector {
 public:
  EliteSelector(const RunConfig& config, torch::Tensor prior);  // prior: network values [N, ...]
  Selection Select(const ScoredStage& scored, int episode) const;

  // Network values [K, 1, n, n, n] of the elites as they are learnt from: those that were sampled
  // or, with cem.redistance, those of the exact distances to their meshes, float16.
  torch::Tensor Elites(const ScoredStage& scored, const Selection& selection) const;

  // What the next episode trains on, float16: the elites, then the replayed shapes.
  torch::Tensor TrainingSet(const torch::Tensor& elites, const Selection& selection) const;

 private:
  std::vector<std::int64_t> CellsOf(const torch::Tensor& values) const;

  const RunConfig& config_;
  torch::Tensor prior_;
  torch::Tensor centres_;                             // [cells, r^3] float32
  std::vector<std::vector<std::int64_t>> residents_;  // of each cell: prior shapes
};

}  // namespace antigrasp
