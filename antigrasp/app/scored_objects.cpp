#include "antigrasp/app/scored_objects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/app/console.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

// "," and the number, nothing for a number that does not exist.
std::string NumberField(double value) {
  return "," + (std::isnan(value) ? std::string() : FormatDouble(value));
}

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

std::string ScoresCsv(const std::vector<ScoredObject>& scored, const ScoresCsvColumns& columns) {
  std::string csv =
      "object,status,num_grasps,graspability,ci_low,ci_high,mean,fraction_nonzero,seconds";
  if (columns.egad) csv += ",egad";
  if (columns.baselines != nullptr) csv += ",baseline,difference";
  csv += "\n";
  for (std::size_t i = 0; i < scored.size(); ++i) {
    const ScoredObject& item = scored[i];
    const Graspability& score = item.score;
    csv += CsvField(item.object.name) + "," + CsvField(item.Status()) + "," +
           std::to_string(score.grasps.size());
    const bool evaluated = score.status != GraspabilityStatus::kNotEvaluable;
    for (const double value :
         {score.value, score.ci_low, score.ci_high, score.mean, score.fraction_nonzero}) {
      csv += NumberField(evaluated ? value : std::numeric_limits<double>::quiet_NaN());
    }
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, ",%.4f", score.seconds);
    csv += seconds;
    if (columns.egad) csv += NumberField(EgadScore(item.Value()));
    if (columns.baselines != nullptr) {
      const double baseline = (*columns.baselines)[i].Value();
      csv += NumberField(baseline) + NumberField(item.Value() - baseline);
    }
    csv += "\n";
  }
  return csv;
}

std::string MetricToml(const MetricOptions& metric, std::uint64_t seed) {
  MetricOptions copy = metric;
  OptionTable table;
  Bind(&table, &copy);
  return "seed = " + std::to_string(seed) + "\n\n" + table.Dump();
}

std::string GraspsCsv(const std::vector<ScoredObject>& scored) {
  std::string csv =
      "object,grasp,p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,axis_x,axis_y,axis_z,width,"
      "robust_quality,approach_x,approach_y,approach_z,comx,comy,comz,in1x,in1y,in1z,in2x,in2y,"
      "in2z\n";
  for (const ScoredObject& item : scored) {
    if (item.score.grasps.empty()) continue;
    const Eigen::Vector3d com = item.score.scale * CenterOfMass(item.object.mesh);
    for (std::size_t g = 0; g < item.score.grasps.size(); ++g) {
      const ScoredGrasp& scored_grasp = item.score.grasps[g];
      csv += CsvField(item.object.name) + "," + std::to_string(g);
      const auto add = [&](const Eigen::Vector3d& v) {
        for (int k = 0; k < 3; ++k) csv += "," + FormatDouble(v[k]);
      };
      for (const Contact& contact : scored_grasp.grasp.contacts) {
        add(contact.point);
        add(contact.normal);
      }
      add(scored_grasp.grasp.axis);
      csv +=
          "," + FormatDouble(scored_grasp.grasp.width) + "," + FormatDouble(scored_grasp.quality);
      add(scored_grasp.grasp.approach);
      add(com);
      add(scored_grasp.grasp.axis);  // the two jaws' closing directions, as `quality` reads them
      add(-scored_grasp.grasp.axis);
      csv += "\n";
    }
  }
  return csv;
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
