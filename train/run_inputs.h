#pragma once

#include <functional>

#include "antigrasp/core/observer.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/train/run_config.h"

// What a run begins with, whoever keeps it.
namespace antigrasp {

// Who makes a prior set in place of MakePriorSet.
using PriorMaker = std::function<ShapeSet(const PriorSetOptions&, const ProgressFn&)>;

// The prior set: read, or made at the resolution of the model (`make` empty: by this process).
// InputError for a file that is none.
ShapeSet PriorOf(const RunConfig& config, RunObserver* observer, const PriorMaker& make = nullptr);

// Of a run with config.start: InputError for networks of another model, or without config.fine_tune
// of another prior set, than the configuration has.
void RequireFittingStart(const RunConfig& config);

}  // namespace antigrasp
