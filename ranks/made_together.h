#pragma once

#include "antigrasp/core/work_share.h"
#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/train/cem_run.h"

namespace antigrasp {

// What a run makes besides samples, by all ranks: the prior set, and elites as they are refined.
// RunParts of rank 0.
PriorMaker RankedPrior(RankGroup* group, WorkShare* share);
EliteRefiner RankedRefiner(RankGroup* group, WorkShare* share, MeshRefiner refine);

// The same of the others, when they hear the order.
void HelpWithPrior(WorkShare* share);
void HelpRefining(WorkShare* share, const MeshRefiner& refine, const RunConfig& config);

}  // namespace antigrasp
