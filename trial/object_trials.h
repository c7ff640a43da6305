#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

// Objects to be tried in physics, and what is to be written.
struct PhysicsTrialRequest {
  std::vector<std::string> inputs, baseline;
  std::string out;                // a folder; may be empty
  std::vector<double> frictions;  // one trial each; planned and executed at it
  double equal_mass = 0.05;       // kg, of every object of a comparison
  int replays = 2;                // of an object, held and lost ones each
  bool overwrite = false;
  std::uint64_t seed = 1;
  int threads = 0;
  WorkShare* share = nullptr;  // whose ranks try together; those that help get no report
};

struct PhysicsTrialReport {
  std::string text;                   // tables, means, differences
  std::vector<std::string> warnings;  // repaired, not tried, of an unlikely size
  bool interrupted = false;           // by the observer; the text says how far it came
};

// Tries object after object, each beside its original where there are originals, at the own mass of
// both and at an equal one. Fills the folder with trials.csv, means.csv, executions.csv,
// replays.json and trial.toml. Memory does not grow with the number of objects but for a row each.
// Sets malloc's threshold of the process for that (glibc). When the observer throws Interrupted,
// what was tried is kept, and a call of the same request goes on with it: to the bytes of one that
// was not interrupted. InputError, with nothing written, when no share was held of anything.
PhysicsTrialReport TryInPhysics(const PhysicsTrialRequest& request, const MetricOptions& metric,
                                const PhysicsTrialOptions& options, RunObserver* observer);

}  // namespace antigrasp
