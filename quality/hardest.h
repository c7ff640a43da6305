#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "antigrasp/quality/score_table.h"

namespace antigrasp {

// An object that was chosen for its low score. That score is too low, because of many noisy ones it
// was the lowest; the second one, of draws that chose nothing, is not.
struct HardestObject {
  std::int64_t place = 0;               // in the set
  ScoreRow row;                         // of scores.csv, with both scores
  double chosen_by = 0.0, fresh = 0.0;  // graspabilities
};

struct HardestObjects {
  std::vector<HardestObject> objects;  // lowest first
  // Of the set's others: without any grasp. A graspability of 0 for want of one says that the
  // object is too wide, or that the gripper finds no way in: not how well it is held.
  std::vector<std::string> no_grasps;
  std::int64_t not_scored = 0;
  std::int64_t of = 0;  // all
};

// Scores the objects of these places in the set once more, with FreshSeed.
using ScoresAgain =
    std::function<std::vector<Graspability>(const std::vector<std::int64_t>& places)>;

// The objects with the `count` lowest graspabilities of those that have a grasp; of equal ones by
// name, so that no order of the objects matters. All when there are fewer. `rows` are those of the
// whole set.
HardestObjects FindHardest(std::vector<ScoreRow> rows, int count, const ScoresAgain& again);

// Their rows as scores.csv.
std::string HardestCsv(const HardestObjects& hardest);

// "the 5 hardest of 200: mean graspability 0.00112 by the scores that chose them, 0.00131 under
// fresh draws of 1000 grasps"; the number when the second scores took `more_grasps` than the first
// ones, else 0. Further lines for those that were left out of the choice.
std::vector<std::string> HardestText(const HardestObjects& hardest, int more_grasps);

}  // namespace antigrasp
