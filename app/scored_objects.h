#pragma once

#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {

// An object of the command line with its score but without its mesh; not evaluable when the object
// is not usable.
struct ScoredObject {
  std::string name, status, note;
  Eigen::Vector3d center_of_mass, extent;  // in the unit of the mesh; only of a scored one
  Graspability score;
  double Value() const;  // the graspability, NaN when there is none
};

// Draws from the stream of number `stream`: the object's own, or for a pair that of one of the two.
ScoredObject ScoreObject(const InputObject& object, std::uint64_t stream,
                         const MetricOptions& metric, std::uint64_t seed);

// Which original every object has: alone they pair up whatever they are called, else by name
// without the extension. InputError for an object without an original.
std::vector<std::int64_t> PairWithOriginals(const ObjectSource& objects,
                                            const ObjectSource& originals);

// The row of scores.csv. `egad`: with EGAD's score of the same graspability; `baseline`: with the
// original's graspability and the difference.
ScoreRow RowOf(const ScoredObject& scored, bool egad, const double* baseline);

}  // namespace antigrasp
