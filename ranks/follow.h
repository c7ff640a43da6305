#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/core/work_share.h"
#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/train/cem_run.h"

namespace antigrasp {

// The GAN of a configuration whose parts of batches are shared with the ranks of `share`.
std::unique_ptr<ShapeModel> SharingGan(const RunConfig& config, BatchShare* share);

// Rank 0: models whose calls the others repeat, and their end when this goes.
class Leader {
 public:
  explicit Leader(RankGroup* group);
  ~Leader();
  Leader(const Leader&) = delete;
  Leader& operator=(const Leader&) = delete;
  ShapeModelMaker maker();

 private:
  RankGroup* group_;
  std::unique_ptr<BatchShare> share_;
};

// Any other rank: does what rank 0 says until it says the end. Throws what its work throws.
void FollowRanks(RankGroup* group, WorkShare* work, const JudgeMaker& make_judge,
                 const MeshRefiner& refine);

// A run as whatever the environment or `processes` says: alone, as rank 0 of a job, whose model and
// parts `run` then takes, or as another rank, which follows and does not run. `same` and `pause`:
// as for JoinRanks (job.h).
using RunFn = std::function<void(const ShapeModelMaker& make, const RunParts& parts)>;
void RunAsJob(int processes, const std::function<std::vector<std::string>()>& same,
              const std::function<void()>& pause, const JudgeMaker& make_judge,
              const MeshRefiner& refine, const RunFn& run);

// "antigrasp 1.2 (abc1234)" and the configuration, as all ranks must have them (JoinOptions::same).
std::vector<std::string> SameForAll(const RunConfig& config);

}  // namespace antigrasp
