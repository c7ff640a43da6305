#pragma once

#include <string>

#include "antigrasp/core/work_share.h"
#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/train/cem_run.h"

namespace antigrasp {

// Scores samples of a stage that the ranks share: each takes the next few until none is left, so
// that a slow machine does less; rank 0 gets all results, and what another fails with. `judge`:
// nullptr, the metric.
ScoredStage ScoreTogether(WorkShare* share, std::int64_t job, const torch::Tensor& values,
                          const RunConfig& config, Judge* judge, const ProgressFn& progress);

// RunParts::make_scorer of rank 0. Scores have the same bytes as one process's.
ScorerMaker RankedScorer(RankGroup* group, WorkShare* share);

// What one rank sends another of a part of a stage. Grasps are left out but for their number.
std::string BytesOf(const ScoredStage& stage);
// Into the places from `first` on. RuntimeFailure for bytes that do not fit.
void TakeScored(const std::string& bytes, std::int64_t first, ScoredStage* all);

}  // namespace antigrasp
