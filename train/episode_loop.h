#pragma once

#include <torch/types.h>

#include <functional>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/cem_loop.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/shape_model.h"
#include "antigrasp/train/statistics.h"

namespace antigrasp {

// Runs the episodes of the run in `folder` from its last checkpoint (or the beginning) to the end,
// with a fresh `model`, whose samples `scorer` scores. The folder holds config.toml and prior.h5,
// whose network values are `prior`. Calls `first_trained` once episode 0's checkpoint is there;
// where that says that somebody else makes the control, no time is foretold for it. Returns the
// rows of statistics.csv. InputError: the checkpoint is another model's.
std::vector<StageStatistics> RunEpisodes(const RunConfig& config, const RunFolder& folder,
                                         ShapeModel* model, const torch::Tensor& prior,
                                         StageScorer scorer, RunObserver* observer,
                                         EliteRefiner refine = nullptr,
                                         const std::function<bool()>& first_trained = nullptr);

}  // namespace antigrasp
