#pragma once

#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {

// An object of the command line with its score; not evaluable when the object is not usable.
struct ScoredObject {
  InputObject object;
  Graspability score;
  std::string Status() const;
  double Value() const;  // the graspability, NaN when there is none
};

// The changed objects' originals, in the order of `objects`: alone they pair up as they are, else
// by name without the extension. InputError for an object without an original or with several.
std::vector<InputObject> LoadBaselines(const std::vector<std::string>& inputs,
                                       const std::vector<InputObject>& objects, int threads);

// Object i draws from the stream of number i: equal places, equal random numbers. Shows progress.
std::vector<ScoredObject> ScoreObjects(std::vector<InputObject> objects,
                                       const MetricOptions& metric, std::uint64_t seed, int threads,
                                       const std::string& phase);

// The rows of scores.csv. `egad`: with EGAD's score of the same graspability; `baselines`: with
// theirs and the difference.
std::vector<ScoreRow> ScoreRows(const std::vector<ScoredObject>& scored, bool egad,
                                const std::vector<ScoredObject>* baselines);
std::string GraspsCsv(const std::vector<ScoredObject>& scored);

// "12345 candidate grasps: 48 % kept, 20 % slip, ..., 3 copies", by the grasp model's reasons.
std::string AcceptanceLine(const std::vector<ScoredObject>& scored);

}  // namespace antigrasp
