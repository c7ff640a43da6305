#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/shape_model.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// Runs the episodes of the run in `folder` from its last checkpoint (or the beginning) to the end,
// with a fresh `model`. The folder holds config.toml and prior.h5. Returns the rows of
// statistics.csv. InputError: the checkpoint is another model's.
std::vector<StageStatistics> RunEpisodes(const RunConfig& config, const RunFolder& folder,
                                         ShapeModel* model, RunObserver* observer);

// Makes the fresh model that a configuration describes.
using ShapeModelMaker = std::function<std::unique_ptr<ShapeModel>(const RunConfig&)>;
std::unique_ptr<ShapeModel> MakeGan(const RunConfig& config);  // around a MakeTrainer

// Fresh networks as the configuration says, on its device. InputError when LibTorch does not offer
// the device here. Also sets LibTorch's threads.
GanTrainer MakeTrainer(const RunConfig& config);

}  // namespace antigrasp
