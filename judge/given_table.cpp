#include "antigrasp/judge/given_table.h"

#include <cmath>
#include <cstdio>

#include "antigrasp/core/passer.h"

namespace antigrasp {
namespace {

std::vector<std::string> GivenColumns(bool in_physics) {
  std::vector<std::string> columns = {"object",         "grasp", "status",   "epsilon",
                                      "robust_quality", "width", "reachable"};
  if (in_physics) columns.insert(columns.end(), {"trial", "pose", "executions", "held"});
  return columns;
}

std::string PercentOf(int part, int all) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100.0 * part / all);
  return text;
}

}  // namespace

void PassFields(Passer& pass, TriedGrasp& tried) {
  pass(tried.status, tried.pose, tried.executions, tried.held);
}

GivenTable::GivenTable(bool in_physics) : in_physics_(in_physics), csv_(GivenColumns(in_physics)) {}

void GivenTable::Add(const std::string& object, const std::string& status,
                     const std::vector<GivenGrasp>& grasps, const std::vector<GivenScore>& scores,
                     const std::vector<TriedGrasp>& tried) {
  objects_ += grasps.empty() ? 0 : 1;
  for (std::size_t i = 0; i < grasps.size(); ++i) {
    csv_.Text(object).Text(grasps[i].id);
    if (scores.empty()) {
      GivenScore none;
      none.status = status;
      AddScore(none);
    } else {
      AddScore(scores[i]);
    }
    if (in_physics_) AddTrial(tried.empty() ? TriedGrasp{"not scored"} : tried[i]);
    csv_.EndRow();
  }
}

void GivenTable::AddScore(const GivenScore& score) {
  const double nan = std::nan("");
  statuses_.Add(score.status);
  csv_.Text(score.status);
  if (!score.scored()) {
    csv_.NumbersOrGaps({nan, nan, nan}).CountOrGap(-1);
    return;
  }
  csv_.Numbers({score.epsilon, score.robust_quality});
  csv_.NumberOrGap(score.status == GivenScore::kOk ? score.grasp.width : nan);
  csv_.CountOrGap(score.reachable ? *score.reachable : -1);
  ++scored_;
  quality_ += score.robust_quality;
  positive_ += score.robust_quality > 0.0 ? 1 : 0;
  asked_ += score.reachable ? 1 : 0;
  reached_ += score.reachable.value_or(false) ? 1 : 0;
}

void GivenTable::AddTrial(const TriedGrasp& tried) {
  const bool executed = tried.executions > 0;
  trials_.Add(executed ? "executed" : tried.status);
  csv_.Text(tried.status).CountOrGap(tried.pose).Count(tried.executions);
  csv_.NumberOrGap(executed ? static_cast<double>(tried.held) / tried.executions : std::nan(""));
  executions_ += tried.executions;
  held_ += tried.held;
}

std::vector<std::string> GivenTable::Summary() const {
  std::vector<std::string> lines = {std::to_string(statuses_.total()) + " grasps of " +
                                    std::to_string(objects_) + " objects: " + statuses_.Text()};
  if (scored_ > 0) {
    char mean[64];
    std::snprintf(mean, sizeof mean, "mean robust quality %.5f, above 0: ", quality_ / scored_);
    lines.push_back(mean + PercentOf(positive_, scored_));
    if (asked_ > 0) lines.back() += ", the gripper gets to " + PercentOf(reached_, asked_);
  }
  if (in_physics_) {
    lines.push_back("in physics: " + trials_.Text());
    if (executions_ > 0) {
      lines.back() += "; held " + PercentOf(held_, executions_) + " of " +
                      std::to_string(executions_) + " executions";
    }
  }
  return lines;
}

}  // namespace antigrasp
