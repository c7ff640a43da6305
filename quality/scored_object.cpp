#include "antigrasp/quality/scored_object.h"

#include <cmath>
#include <limits>
#include <utility>

namespace antigrasp {

double ScoredObject::Value() const {
  return score.status == GraspabilityStatus::kNotEvaluable
             ? std::numeric_limits<double>::quiet_NaN()
             : score.value;
}

ScoredObject ScoreObject(std::string name, std::string status, const TriangleMesh& mesh,
                         std::uint64_t stream, const MetricOptions& metric, std::uint64_t seed) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  ScoredObject scored{std::move(name), std::move(status), "", none, none, {}};
  scored.score.status = GraspabilityStatus::kNotEvaluable;
  if (scored.status != "ok") return scored;
  scored.score = EvaluateGraspability(mesh, metric, seed, stream);
  scored.status = Name(scored.score.status);
  scored.center_of_mass = CenterOfMass(mesh);
  scored.extent = Bounds(mesh).Extent();
  return scored;
}

ScoreRow RowOf(const ScoredObject& scored, bool egad, const double* baseline) {
  ScoreRow row{scored.name, scored.status, SummaryOf(scored.score)};
  row.extras.emplace_back("seconds", std::round(1e4 * scored.score.seconds) / 1e4);
  if (egad) row.extras.emplace_back("egad", EgadScore(scored.Value()));
  if (baseline != nullptr) {
    row.extras.emplace_back("baseline", *baseline);
    row.extras.emplace_back("difference", scored.Value() - *baseline);
  }
  const bool has_size = row.score.has_value();
  row.extras.emplace_back("metres_per_unit", has_size ? scored.score.scale : std::nan(""));
  for (int axis = 0; axis < 3; ++axis) {
    row.extras.emplace_back(std::string("extent_") + "xyz"[axis],
                            has_size ? scored.extent[axis] : std::nan(""));
  }
  return row;
}

}  // namespace antigrasp
