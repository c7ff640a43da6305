#pragma once

#include "antigrasp/app/flags.h"
#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

// The trial that a protocol and the command's flags ask for; what was typed goes before what the
// protocol lays down, the friction of `metric` included.
PhysicsTrialOptions TrialOptionsOf(const Protocol& protocol, const CLI::App& command,
                                   const OptionFlags& trial_flags, MetricOptions* metric);

}  // namespace antigrasp
