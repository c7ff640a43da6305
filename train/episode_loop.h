#pragma once

#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// Runs the episodes of the run in `folder` from its last checkpoint (or the beginning) to the end.
// The folder holds config.toml and prior.h5. Returns the rows of statistics.csv.
std::vector<StageStatistics> RunEpisodes(const RunConfig& config, const RunFolder& folder,
                                         RunObserver* observer);

// Fresh networks as the configuration says, on its device. InputError when LibTorch does not offer
// the device here. Also sets LibTorch's threads.
GanTrainer MakeTrainer(const RunConfig& config);

}  // namespace antigrasp
