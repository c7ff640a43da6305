#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/app/scored_objects.h"
#include "antigrasp/core/observer.h"

namespace antigrasp {

// --hardest N; 0 when it is not given.
CLI::Option* AddHardestFlag(CLI::App* command, int* count, const std::string& help);

// Scores all objects, with the draws of each one's own stream, for their rows of scores.csv.
std::vector<ScoreRow> ScoreRowsOf(const ObjectSource& objects, const MetricOptions& metric,
                                  std::uint64_t seed, int threads, RunObserver* observer);

// An object that was chosen for its low score. That score is too low, because of many noisy ones it
// was the lowest; the second one, of draws that chose nothing, is not.
struct HardestObject {
  std::int64_t place = 0;               // in the source
  ScoreRow row;                         // of scores.csv, with both scores
  double chosen_by = 0.0, fresh = 0.0;  // graspabilities
};

// The objects with the `count` lowest graspabilities, lowest first; of equal ones by name, so that
// no order of the objects matters. `rows` are those of the source. All usable ones when there are
// fewer. Scores these again, with the seed FreshSeed(seed).
std::vector<HardestObject> FindHardest(const ObjectSource& objects, std::vector<ScoreRow> rows,
                                       int count, const MetricOptions& metric, std::uint64_t seed,
                                       int threads, RunObserver* observer);

// "the 5 hardest of 200: mean graspability 0.00112 by the scores that chose them, 0.00131 under
// fresh draws".
std::string HardestText(const std::vector<HardestObject>& hardest, std::int64_t of);

}  // namespace antigrasp
