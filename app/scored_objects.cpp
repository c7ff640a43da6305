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
  std::vector<Graspability> scores = ScoreAll(
      std::ssize(objects),
      [&](std::int64_t i) {
        const InputObject& object = objects[static_cast<std::size_t>(i)];
        return object.ok() ? &object.mesh : nullptr;
      },
      [](std::int64_t i) { return static_cast<std::uint64_t>(i); }, metric, seed, threads,
      console.Phase(phase));
  std::vector<ScoredObject> scored;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    scored.push_back({std::move(objects[i]), std::move(scores[i])});
  }
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
    sum.Add(item.score.rejected);
  }
  if (attempts == 0.0) return "no candidate grasps";
  const auto number = [](const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return std::string(text);
  };
  std::string line = number("%.0f candidate grasps", attempts);
  line += number(": %.0f %% kept", 100.0 * kept / attempts);
  for (const auto& [reason, count] : sum.reasons) {
    line += number(", %.0f %% ", 100.0 * count / attempts) + reason;
  }
  return line + ", " + std::to_string(sum.copies) + " copies";
}

}  // namespace antigrasp
