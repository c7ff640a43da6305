#include "antigrasp/app/scored_objects.h"

#include <cmath>
#include <limits>
#include <map>

#include "antigrasp/core/error.h"

namespace antigrasp {

double ScoredObject::Value() const {
  return score.status == GraspabilityStatus::kNotEvaluable
             ? std::numeric_limits<double>::quiet_NaN()
             : score.value;
}

ScoredObject ScoreObject(const InputObject& object, std::uint64_t stream,
                         const MetricOptions& metric, std::uint64_t seed) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  ScoredObject scored{object.name, object.status, object.note, none, none, {}};
  scored.score.status = GraspabilityStatus::kNotEvaluable;
  if (!object.ok()) return scored;
  scored.score = EvaluateGraspability(object.mesh, metric, seed, stream);
  scored.status = Name(scored.score.status);
  scored.center_of_mass = CenterOfMass(object.mesh);
  scored.extent = Bounds(object.mesh).Extent();
  return scored;
}

std::vector<std::int64_t> PairWithOriginals(const ObjectSource& objects,
                                            const ObjectSource& originals) {
  if (objects.size() == 1 && originals.size() == 1) return {0};
  std::map<std::string, std::int64_t> place;  // names are told apart by their file names
  for (std::int64_t i = 0; i < originals.size(); ++i) place[FileNameOf(originals.name(i))] = i;
  std::vector<std::int64_t> pairs;
  for (std::int64_t i = 0; i < objects.size(); ++i) {
    const std::string name = FileNameOf(objects.name(i));
    const auto found = place.find(name);
    if (found == place.end()) {
      throw InputError("0 originals", "--baseline for " + objects.name(i),
                       "exactly one object named " + name);
    }
    pairs.push_back(found->second);
  }
  return pairs;
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
