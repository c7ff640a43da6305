#pragma once

#include <string>

#include "antigrasp/core/observer.h"
#include "antigrasp/judge/object_notes.h"
#include "antigrasp/trial/object_trials.h"

namespace antigrasp {

// Objects tried by the metric's model (RunReadings). Of the request: inputs, out, seed, threads.
// `friction_angle`: degrees; `reading`: the name of a FrictionReading, else all. With `out` a table
// there, and OUT.trial.toml. Returns what is to be read of it. InputError when no object is usable.
std::string TryByModel(const PhysicsTrialRequest& request, const MetricOptions& metric,
                       const TrialOptions& options, double friction_angle,
                       const std::string& reading, RunObserver* observer, const WarnFn& warn);

}  // namespace antigrasp
