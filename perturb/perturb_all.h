#pragma once

#include <functional>
#include <vector>

#include "antigrasp/core/work_share.h"
#include "antigrasp/perturb/perturb_folder.h"

namespace antigrasp {

// Perturbs and scores every usable object. Once `stop` says so, or `progress` throws Interrupted,
// what is not done is marked as interrupted and the rest is kept. Same results for any number of
// threads (0 = all). The ranks of `share` do it together; one that helps gets nothing of the
// others'.
std::vector<PerturbedObject> PerturbAll(std::vector<InputObject> inputs,
                                        const PerturbSettings& settings, int threads,
                                        const std::function<bool()>& stop,
                                        const ProgressFn& progress, WorkShare* share = nullptr);

}  // namespace antigrasp
