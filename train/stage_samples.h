#pragma once

#include <torch/types.h>

#include <cstdint>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// The samples of a finished stage are not stored; these make chosen ones again. Stage -1 is the
// prior set (prior.h5), K >= 0 the samples of episode K (episode_K/checkpoint.pt). The networks run
// on the CPU: samples of a run on another device differ in their last bits. `make`: the shape model
// that the run was started with.

// Network values [indices.size(), 1, n, n, n] of the samples of these indices, in this order.
// InputError when the stage's file is missing or unusable, or has no shape of an index.
torch::Tensor StageValues(const RunFolder& run, const RunConfig& config, int stage,
                          const std::vector<std::int64_t>& indices,
                          const ProgressFn& progress = nullptr,
                          const ShapeModelMaker& make = MakeGan);

// The same, remeshed and scored as the run scored them: item j is sample indices[j].
ScoredStage StageSamples(const RunFolder& run, const RunConfig& config, int stage,
                         const std::vector<std::int64_t>& indices, RunObserver* observer,
                         const ShapeModelMaker& make = MakeGan);

}  // namespace antigrasp
