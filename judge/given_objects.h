#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/grasp_io/grasp_files.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

// Grasps that somebody else planned, to be scored on their objects.
struct GivenRequest {
  std::vector<std::string> inputs;  // objects
  std::string grasps;               // a table (quality/given_grasps.h), or grasp_io/grasp_files.h
  std::string out;                  // table to write, OUT.metric.toml beside it; may be empty
  std::vector<GivenGrasp>
      sampled;              // in place of `grasps`, by AddGiven: OUT.trial.toml alone is written
  bool in_physics = false;  // each is executed, too
  std::uint64_t seed = 1;
  int threads = 0;
  GraspOutput
      output;  // of the grasps with their labels; `about.base` is of the gripper that scores
  // Whose ranks score together; rank 0 tells the others what was sampled. Those get no report.
  WorkShare* share = nullptr;
};

// Grasps of an object as they were sampled and scored, to be executed: they score the same again.
void AddGiven(const ScoredObject& scored, std::vector<GivenGrasp>* grasps);

struct GivenReport {
  std::string table;  // where nothing is written: what would have been
  std::vector<std::string> summary, warnings;
};

// A row for every grasp of the objects, in the order of objects and then of the table: `object,
// grasp, status, epsilon, robust_quality, width, reachable` and, in physics, `trial, pose,
// executions, held` (docs/formats.md). `trial_metric`: the metric with what the protocol lays down
// (ApplyProtocol). Rows of a table belong to the object of their name or file name, those without a
// name to an only one; those of a file of grasps to the object whose mesh it names, in whatever
// folder, and that object is scored at the scale which the file says unless it keeps its size.
// InputError, with nothing written, when none belongs to any, when no object is usable, and for
// another metres_per_unit in the table than the object is scored at.
GivenReport ScoreGiven(const GivenRequest& request, const MetricOptions& metric,
                       const MetricOptions& trial_metric, const PhysicsTrialOptions& trial,
                       RunObserver* observer);

}  // namespace antigrasp
