#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/hardest.h"
#include "antigrasp/quality/scored_set.h"

namespace antigrasp {

// How the objects of a command line are scored, alike by every command that does.
struct Scoring {
  MetricOptions metric;
  bool effort_given = false;  // MetricFlags
  bool egad = false;          // ScoredSet
  std::uint64_t seed = 1;
  int threads = 0;
};

// Draws from the stream of number `stream`: the object's own, or for a pair that of one of the two.
ScoredObject ScoreObject(const InputObject& object, std::uint64_t stream, const Scoring& scoring);

// Object by object in their order, each with its original where there are any (`original_of`: its
// place there); `take` gets each with its row of scores.csv. Warns; InputError when none has a
// score, of the input `where`.
using TakeScored = std::function<void(const ScoredObject&, const ScoreRow&)>;
ScoredSet ScoreObjects(const ObjectSource& objects, const std::string& where,
                       const ObjectSource* originals, const std::vector<std::int64_t>& original_of,
                       const Scoring& scoring, const TakeScored& take);

// --hardest N; 0 when it is not given.
CLI::Option* AddHardestFlag(CLI::App* command, int* count, const std::string& help);

// The N hardest of the objects, scored again, and what is to be said of it. The second time they
// are few, and get as many grasps as few objects do. InputError when none has a grasp.
struct HardestOfSet : HardestObjects {
  std::vector<std::string> summary;
};
HardestOfSet FindHardest(const ObjectSource& objects, const std::string& where, int count,
                         const Scoring& scoring);

}  // namespace antigrasp
