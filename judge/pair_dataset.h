#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

// Objects before and after a change, to be written as a set that a policy can be trained on.
struct PairRequest {
  std::string before, after;  // meshes, folders, SDF files; paired by name
  std::string out;            // folder
  double train = 0.8;         // share of the objects; the rest behind train and val is test
  double val = 0.1;
  std::string license;  // of the data, for the datasheet; empty: to be filled in
  bool overwrite = false;
  std::uint64_t seed = 1;
  int threads = 0;
};

struct PairReport {
  std::string text;                   // what was written, what the change did
  std::vector<std::string> warnings;  // repaired, left out
};

// Fills the folder (docs/formats.md, "Pairs of objects"):
//   before/NAME.obj, after/NAME.obj   in metres, at the size that the metric looks at
//   objects.csv                       a row an object and side: split, both judges' labels
//   grasps_before.csv, grasps_after.csv
//                                     grasps planned for the trial, in the frame of those meshes,
//                                     each with its robust quality and the share held
//   datasheet.md, metric.toml, trial.toml
// Judges: graspability under `metric`, and the trial (`trial.protocol`, at trial_metric's friction,
// trial.mass). Both sides of an object have equal draws and are in one split. An object that cannot
// be scored and tried on both sides has a row that says why, and no files. InputError, with nothing
// written, when none can, and for an object without its pair. The same bytes for any number of
// threads.
PairReport WritePairDataset(const PairRequest& request, const MetricOptions& metric,
                            const MetricOptions& trial_metric, const PhysicsTrialOptions& trial,
                            RunObserver* observer);

}  // namespace antigrasp
