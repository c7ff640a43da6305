#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/train/run_config.h"

// What a run begins with, whoever keeps it.
namespace antigrasp {

// The prior set: read, or made at the resolution of the model. InputError for a file that is none.
ShapeSet PriorOf(const RunConfig& config, RunObserver* observer);

// Of a run with config.start: InputError for networks of another model, or without config.fine_tune
// of another prior set, than the configuration has.
void RequireFittingStart(const RunConfig& config);

}  // namespace antigrasp
