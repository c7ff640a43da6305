#pragma once

#include "antigrasp/app/flags.h"
#include "antigrasp/trial/trial_options.h"

namespace antigrasp {

// An option of a trial each, in a group of their own.
std::shared_ptr<OptionFlags> AddTrialFlags(CLI::App* command);

// What was typed of a trial. `flags` must live as long as it.
TypedTrial TypedOf(const CLI::App& command, const OptionFlags& flags);

}  // namespace antigrasp
