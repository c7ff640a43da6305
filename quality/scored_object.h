#pragma once

#include <Eigen/Core>
#include <string>

#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {

// An object with its score but without its mesh; not evaluable when the object is not usable.
struct ScoredObject {
  std::string name, status, note;
  Eigen::Vector3d center_of_mass, extent;  // in the unit of the mesh; only of a scored one
  Graspability score;
  double Value() const;  // the graspability, NaN when there is none
};

// EvaluateGraspability, and what a table says beside it. `status`: "ok", or why the object is not
// usable, and then it is not scored.
ScoredObject ScoreObject(std::string name, std::string status, const TriangleMesh& mesh,
                         std::uint64_t stream, const MetricOptions& metric, std::uint64_t seed);

// The row of scores.csv. `egad`: with EGAD's score of the same graspability; `baseline`: with the
// original's graspability and the difference.
ScoreRow RowOf(const ScoredObject& scored, bool egad, const double* baseline);

}  // namespace antigrasp
