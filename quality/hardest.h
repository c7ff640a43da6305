#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {

// An object that was chosen for its low score. That score is too low, because of many noisy ones it
// was the lowest; the second one, of draws that chose nothing, is not.
struct HardestObject {
  std::int64_t place = 0;               // in the set
  ScoreRow row;                         // of scores.csv, with both scores
  double chosen_by = 0.0, fresh = 0.0;  // graspabilities
};

// Scores the object of this place in the set once more, with FreshSeed; any thread may call.
using ScoreAgain = std::function<Graspability(std::int64_t place)>;

// The objects with the `count` lowest graspabilities, lowest first; of equal ones by name, so that
// no order of the objects matters. `rows` are those of the whole set. All usable ones when there
// are fewer.
std::vector<HardestObject> FindHardest(std::vector<ScoreRow> rows, int count,
                                       const ScoreAgain& again, int threads,
                                       const ProgressFn& progress);

// Their rows as scores.csv.
std::string HardestCsv(const std::vector<HardestObject>& hardest);

// "the 5 hardest of 200: mean graspability 0.00112 by the scores that chose them, 0.00131 under
// fresh draws".
std::string HardestText(const std::vector<HardestObject>& hardest, std::int64_t of);

}  // namespace antigrasp
