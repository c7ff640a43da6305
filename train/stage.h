#pragma once

#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/sdf/remesh.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/statistics.h"

namespace antigrasp {

// The objects of one stage, all scored: item i of each vector is sample i.
struct ScoredStage {
  torch::Tensor values;                // network values [N, 1, n, n, n]
  std::vector<RemeshResult> objects;   // meshes and the reason a grid was rejected
  std::vector<Graspability> scores;    // kNotEvaluable for rejected grids
  std::vector<double> graspabilities;  // NaN for rejected grids
};

// The seed of the latent vectors of an episode's samples.
std::uint64_t StageSeed(const RunConfig& config, int episode);

// Remeshes and scores network values (paper III-B, VI-C), value i as sample i: stages compare with
// common random numbers.
ScoredStage ScoreStage(const torch::Tensor& values, const RunConfig& config,
                       const std::string& name, RunObserver* observer);

// The same of some samples of a stage: value j is sample indices[j].
ScoredStage ScoreSamples(const torch::Tensor& values, const std::vector<std::int64_t>& indices,
                         const RunConfig& config, const ProgressFn& progress);

// The same with another score in the place of the graspability. It is asked for every usable
// object, on any thread; lower is kept. NaN: the object counts as rejected.
using MeshScore = std::function<double(const TriangleMesh&)>;
ScoredStage ScoreStageBy(const MeshScore& score, const torch::Tensor& values,
                         const RunConfig& config, const ProgressFn& progress);

// The same by a judge, in batches; an object without a verdict's score counts as rejected.
// RuntimeFailure when the judge stops. `progress` counts every object twice: made, judged.
ScoredStage ScoreStageBy(Judge* judge, const torch::Tensor& values, const RunConfig& config,
                         const ProgressFn& progress);

// The same of some samples of a stage: value j is sample indices[j].
ScoredStage JudgeSamples(Judge* judge, const torch::Tensor& values,
                         const std::vector<std::int64_t>& indices, const RunConfig& config,
                         const ProgressFn& progress);

// Counts, mean graspability, similarity to the prior set (network values) and the shares of flat
// edges and creases (meshes).
StageStatistics Summarize(int stage, const ScoredStage& scored, const torch::Tensor& prior,
                          const RunConfig& config);

// scores.csv: one row per sample, no wall time in it, so that equal runs write equal bytes.
// Samples go by SampleName, the shapes of the prior set (stage -1) by their place in prior.h5.
std::string StageScoresCsv(int stage, const ScoredStage& scored);

std::vector<std::int64_t> Every(std::int64_t count);  // 0 to count - 1

// A grid of distances from one sample's network values.
SdfGrid GridOf(const torch::Tensor& value, const ModelOptions& model);

// Network values [N, 1, n, n, n] float16 of a shape set's grids. InputError for grids of another
// resolution than the model's.
torch::Tensor NetworkValuesOf(const ShapeSet& set, const ModelOptions& model,
                              const std::string& origin);

}  // namespace antigrasp
