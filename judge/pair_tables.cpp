#include "antigrasp/judge/pair_tables.h"

#include <array>
#include <cmath>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/core/word_count.h"
#include "antigrasp/quality/grasp_table.h"

namespace antigrasp {
namespace {

std::vector<std::string> WithVectors(std::vector<std::string> columns,
                                     const std::vector<std::string>& vectors) {
  for (const std::string& vector : vectors) {
    for (const char axis : {'x', 'y', 'z'}) columns.push_back(vector + "_" + axis);
  }
  return columns;
}

std::vector<std::string> GraspColumns() {
  std::vector<std::string> columns =
      WithVectors({"object", "split", "grasp"}, {"center", "axis", "approach", "up"});
  for (const char* name :
       {"width", "pose", "candidate", "robust_quality", "executions", "held", "frame"}) {
    columns.emplace_back(name);
  }
  return columns;
}

}  // namespace

PairObjects::PairObjects()
    : csv_({"object",       "side",      "split",           "status",
            "mesh",         "triangles", "volume",          "extent_x",
            "extent_y",     "extent_z",  "metres_per_unit", "mass",
            "graspability", "ci_low",    "ci_high",         "held",
            "held_low",     "held_high", "grasps",          "executions",
            "kept",         "untrusted", "held_best"}) {}

void PairObjects::Add(const LabelledObject& object) {
  csv_.Text(object.object).Text(object.side).Text(object.split).Text(object.status);
  csv_.Text(object.mesh);
  if (!object.ok()) {
    csv_.CountOrGap(-1);
    for (int i = 0; i < 12; ++i) csv_.NumberOrGap(std::nan(""));
    csv_.Count(0).Count(0).NumberOrGap(std::nan("")).Count(0).NumberOrGap(std::nan("")).EndRow();
    return;
  }
  const Eigen::Vector3d extent = Bounds(object.solid).Extent();
  const TrialSummary& trial = object.summary;
  const Share& held = trial.held.front();
  csv_.Count(std::ssize(object.solid.faces));
  csv_.Numbers({Volume(object.solid), extent.x(), extent.y(), extent.z(), object.score.scale});
  csv_.Numbers({trial.mass, object.score.value, object.score.ci_low, object.score.ci_high});
  csv_.NumbersOrGaps({held.value, held.interval.low, held.interval.high});
  csv_.Count(trial.grasps).Count(trial.executions).NumberOrGap(trial.Kept());
  csv_.Count(trial.untrusted);
  csv_.NumberOrGap(trial.group[static_cast<std::size_t>(GraspGroup::kBest)]).EndRow();
}

PairGrasps::PairGrasps() : csv_(GraspColumns()) {}

void PairGrasps::Add(const LabelledObject& object) {
  const auto add = [&](const Eigen::Vector3d& v) { csv_.Numbers({v.x(), v.y(), v.z()}); };
  std::int64_t number = 0;
  for (const ExecutedGrasp& executed : object.trial.grasps) {
    const TrialGrasp& planned = executed.planned;
    int held = 0;
    for (const ExecutedDraw& draw : executed.draws) held += draw.execution.stages > 0 ? 1 : 0;
    csv_.Text(object.object).Text(object.split).Count(number++);
    add(planned.grasp.center + object.place);
    add(planned.grasp.axis);
    add(planned.grasp.approach);
    if (object.up.empty()) {
      for (int i = 0; i < 3; ++i) csv_.NumberOrGap(std::nan(""));
    } else {
      add(object.up[planned.pose]);
    }
    csv_.Number(planned.grasp.width);
    csv_.CountOrGap(object.up.empty() ? -1 : static_cast<std::int64_t>(planned.pose));
    csv_.CountOrGap(planned.candidate ? static_cast<std::int64_t>(*planned.candidate) : -1);
    csv_.Number(planned.quality).Count(std::ssize(executed.draws));
    csv_.Number(static_cast<double>(held) / static_cast<double>(executed.draws.size()));
    csv_.Text(ChoiceName(GraspFrame::kMesh)).EndRow();
  }
}

std::string PairFolderText(const std::filesystem::path& folder) {
  CsvReader csv(folder / "objects.csv");
  const std::size_t side = csv.RequiredColumn("side"), split = csv.RequiredColumn("split"),
                    status = csv.RequiredColumn("status"),
                    graspability = csv.RequiredColumn("graspability"),
                    held = csv.RequiredColumn("held");
  std::array<std::vector<double>, 2> scores, shares;  // before, after
  WordCount splits, left_out;
  while (csv.Next()) {
    const bool after = csv.Field(side) == "after";
    if (csv.Field(status) != "ok") {
      if (after) left_out.Add(csv.Field(status));
      continue;
    }
    if (after) splits.Add(csv.Field(split));
    scores[after ? 1 : 0].push_back(csv.NumberOrGap(graspability));
    shares[after ? 1 : 0].push_back(100.0 * csv.NumberOrGap(held));
  }
  const auto change = [](const std::array<std::vector<double>, 2>& values, int decimals) {
    return MeanText(MeanWithInterval(values[0]), decimals) + " before, " +
           MeanText(MeanWithInterval(values[1]), decimals) + " after";
  };
  std::string text = folder.string() + ": pairs of objects, " + std::to_string(splits.total()) +
                     " (" + splits.Text() + ")\n";
  if (left_out.total() > 0) text += "  left out      " + left_out.Text() + "\n";
  return text + "  graspability  " + change(scores, 5) + "\n  held, %       " + change(shares, 1) +
         "\n";
}

}  // namespace antigrasp
