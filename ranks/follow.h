#pragma once

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
void FollowRanks(RankGroup* group, const JudgeMaker& make_judge);

// "antigrasp 1.2 (abc1234)" and the configuration, as all ranks must have them (JoinOptions::same).
std::vector<std::string> SameForAll(const RunConfig& config);

}  // namespace antigrasp
