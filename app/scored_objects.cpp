#include "antigrasp/app/scored_objects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/app/console.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

// The one original of this name.
InputObject ByName(const std::string& name, const std::vector<InputObject>& originals) {
  const auto is_it = [&](const InputObject& o) { return FileNameOf(o.name) == FileNameOf(name); };
  const auto count = std::count_if(originals.begin(), originals.end(), is_it);
  if (count != 1) {
    throw InputError(std::to_string(count) + " originals", "--baseline for " + name,
                     "exactly one object named " + FileNameOf(name));
  }
  return *std::find_if(originals.begin(), originals.end(), is_it);
}

}  // namespace

std::string ScoredObject::Status() const {
  return object.ok() ? std::string(Name(score.status)) : object.status;
}

double ScoredObject::Value() const {
  return score.status == GraspabilityStatus::kNotEvaluable
             ? std::numeric_limits<double>::quiet_NaN()
             : score.value;
}

std::vector<InputObject> LoadBaselines(const std::vector<std::string>& inputs,
                                       const std::vector<InputObject>& objects, int threads) {
  ConsoleObserver console;
  auto originals = LoadObjects(inputs, threads, console.Phase("reading the baseline"));
  if (objects.size() == 1 && originals.size() == 1) return originals;
  std::vector<InputObject> in_order;
  for (const InputObject& object : objects) in_order.push_back(ByName(object.name, originals));
  return in_order;
}

std::vector<ScoredObject> ScoreObjects(std::vector<InputObject> objects,
                                       const MetricOptions& metric, std::uint64_t seed, int threads,
                                       const std::string& phase) {
  ConsoleObserver console;
  std::vector<ScoredObject> scored(objects.size());
  ParallelFor(
      static_cast<std::int64_t>(objects.size()), threads,
      [&](std::int64_t i) {
        ScoredObject& item = scored[static_cast<std::size_t>(i)];
        item.object = std::move(objects[static_cast<std::size_t>(i)]);
        if (!item.object.ok()) return;
        item.score =
            EvaluateGraspability(item.object.mesh, metric, seed, static_cast<std::uint64_t>(i));
      },
      console.Phase(phase));
  return scored;
}

std::vector<ScoreRow> ScoreRows(const std::vector<ScoredObject>& scored, bool egad,
                                const std::vector<ScoredObject>* baselines) {
  std::vector<ScoreRow> rows;
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const ScoredObject& item = scored[i];
    ScoreRow row{item.object.name, item.Status(), SummaryOf(item.score)};
    row.extras.emplace_back("seconds", std::round(1e4 * item.score.seconds) / 1e4);
    if (egad) row.extras.emplace_back("egad", EgadScore(item.Value()));
    if (baselines != nullptr) {
      const double baseline = (*baselines)[i].Value();
      row.extras.emplace_back("baseline", baseline);
      row.extras.emplace_back("difference", item.Value() - baseline);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string GraspsCsv(const std::vector<ScoredObject>& scored) {
  CsvWriter csv({"object",
                 "grasp",
                 "p1x",
                 "p1y",
                 "p1z",
                 "n1x",
                 "n1y",
                 "n1z",
                 "p2x",
                 "p2y",
                 "p2z",
                 "n2x",
                 "n2y",
                 "n2z",
                 "axis_x",
                 "axis_y",
                 "axis_z",
                 "width",
                 "robust_quality",
                 "approach_x",
                 "approach_y",
                 "approach_z",
                 "comx",
                 "comy",
                 "comz",
                 "in1x",
                 "in1y",
                 "in1z",
                 "in2x",
                 "in2y",
                 "in2z"});
  const auto add = [&](const Eigen::Vector3d& v) { csv.Numbers({v.x(), v.y(), v.z()}); };
  for (const ScoredObject& item : scored) {
    if (item.score.grasps.empty()) continue;
    const Eigen::Vector3d com = item.score.scale * CenterOfMass(item.object.mesh);
    for (std::size_t g = 0; g < item.score.grasps.size(); ++g) {
      const auto& [grasp, quality, draws] = item.score.grasps[g];
      csv.Text(item.object.name).Count(std::int64_t(g));
      for (const Contact& contact : grasp.contacts) {
        add(contact.point);
        add(contact.normal);
      }
      add(grasp.axis);
      csv.Numbers({grasp.width, quality});
      add(grasp.approach);
      add(com);
      add(grasp.axis);  // the two jaws' closing directions, as `quality` reads them
      add(-grasp.axis);
      csv.EndRow();
    }
  }
  return csv.text();
}

std::string AcceptanceLine(const std::vector<ScoredObject>& scored) {
  double attempts = 0.0, kept = 0.0;
  RejectedGrasps sum;
  for (const ScoredObject& item : scored) {
    attempts += item.score.attempts;
    kept += static_cast<double>(item.score.grasps.size());
    sum.no_opposite += item.score.rejected.no_opposite;
    sum.slips += item.score.rejected.slips;
    sum.jaw_blocked += item.score.rejected.jaw_blocked;
    sum.copies += item.score.rejected.copies;
    sum.gripper_collides += item.score.rejected.gripper_collides;
  }
  if (attempts == 0.0) return "no candidate grasps";
  char line[256];
  const auto share = [&](double part) { return 100.0 * part / attempts; };
  std::snprintf(line, sizeof line,
                "%.0f candidate grasps: %.0f %% kept, %.0f %% nothing within the opening, %.0f %% "
                "slip, %.0f %% jaw blocked, %.0f %% gripper collides, %d copies",
                attempts, share(kept), share(sum.no_opposite), share(sum.slips),
                share(sum.jaw_blocked), share(sum.gripper_collides), sum.copies);
  return line;
}

}  // namespace antigrasp
