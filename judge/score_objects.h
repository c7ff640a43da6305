#pragma once

#include <functional>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/judge/object_notes.h"
#include "antigrasp/quality/hardest.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/quality/scored_set.h"

namespace antigrasp {

// How the objects of a command line are scored, alike by every command that does.
struct Scoring {
  MetricOptions metric;
  bool effort_given = false;  // somebody said how many grasps an object gets
  bool egad = false;          // ScoredSet
  std::uint64_t seed = 1;
  int threads = 0;
  RunObserver* observer = nullptr;  // needed
  WarnFn warn = nullptr;            // needed; before the result
  Judge* judge = nullptr;      // scores every usable object, too: columns judge and judge_status
  WorkShare* share = nullptr;  // whose ranks score together, each with a judge of its own
};

// Draws from the stream of number `stream`: the object's own, or for a pair that of one of the two.
ScoredObject ScoreObject(const InputObject& object, std::uint64_t stream, const Scoring& scoring);

// Object by object in their order, each with its original where there are any (`original_of`: its
// place there); `take` gets each with its row of scores.csv. Warns; InputError when none has a
// score, of the input `where`. Memory does not grow with the set but for some hundred bytes an
// object. On a rank that helps nothing is taken, and the set is empty.
using TakeScored = std::function<void(const ScoredObject&, const ScoreRow&)>;
ScoredSet ScoreObjects(const ObjectSource& objects, const std::string& where,
                       const ObjectSource* originals, const std::vector<std::int64_t>& original_of,
                       const Scoring& scoring, const TakeScored& take);

// Call when the scores are written, which the metric's are worth: RuntimeFailure for a judge that
// was given up, InputError for one that scored nothing.
void RequireAVerdict(const ScoredSet& set, const Judge* judge);

// The N hardest of the objects, scored again, and what is to be said of it. The second time they
// are few, and get as many grasps as few objects do. InputError when none has a grasp. Nothing on a
// rank that helps.
struct HardestOfSet : HardestObjects {
  std::vector<std::string> summary;
};
HardestOfSet FindHardest(const ObjectSource& objects, const std::string& where, int count,
                         const Scoring& scoring);

}  // namespace antigrasp
