#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/ranks/spawn.h"

namespace antigrasp {

// A process's place in its job, for as long as the command runs.
class Ranks {
 public:
  Ranks(std::unique_ptr<SpawnedRanks> spawned, std::unique_ptr<RankGroup> group);
  RankGroup& group() { return *group_; }

 private:
  std::unique_ptr<SpawnedRanks> spawned_;  // ended after the group is
  std::unique_ptr<RankGroup> group_;
};

// The words that this program was called with, its own name first.
std::vector<std::string> OwnArguments();

// Joins the other processes of the job that the environment tells of, or starts `processes` - 1 of
// them where it tells of none; nullptr: this process is alone. `same`: what all must have
// (JoinOptions), asked for only then; `pause` is called while it waits and may throw Interrupted.
// Ranks other than 0 do not hear Ctrl-C: rank 0 ends them.
std::unique_ptr<Ranks> JoinRanks(int processes,
                                 const std::function<std::vector<std::string>()>& same,
                                 const std::function<void()>& pause);

// For a program that fails with `line`: whether this process says so. Of a job whose ranks have not
// met yet the first of those that fail does, and the others hear of it; later LeaveWith
// (ranked_share.h) has seen to it. Waits for the others, some seconds at most.
bool SaysFailure(int exit_code, const std::string& line);

}  // namespace antigrasp
