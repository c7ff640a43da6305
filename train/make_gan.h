#pragma once

#include <functional>
#include <memory>

#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/shape_model.h"

namespace antigrasp {

// Makes the fresh model that a configuration describes.
using ShapeModelMaker = std::function<std::unique_ptr<ShapeModel>(const RunConfig&)>;
std::unique_ptr<ShapeModel> MakeGan(const RunConfig& config);  // around a MakeTrainer

// Fresh networks as the configuration says, on its device. InputError when LibTorch does not offer
// the device here. Also sets LibTorch's threads.
GanTrainer MakeTrainer(const RunConfig& config);

}  // namespace antigrasp
