#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "antigrasp/quality/graspability.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {

// One row of a run (statistics_table.h): what was sampled at a stage and how hard it is to grasp.
// Stage -1 is the prior set, 0 the GAN trained on it, k the GAN retrained k times.
struct StageStatistics {
  int stage = -1;
  int samples = 0;
  std::array<int, kNumRemeshStatuses> by_status{};  // indexed by RemeshStatus
  int scored = 0;
  int without_grasps = 0;  // graspability 0 because no grasp was found
  MeanInterval graspability;
  double elite_threshold = 0.0;  // the highest graspability kept; NaN of the prior set
  double coverage = 0.0;  // prior_similarity.h, against the prior set; NaN for the prior itself
  double nna = 0.0;
  double duplicates = 0.0;
  double diversity = 0.0;
  // Mean shares of edges of the usable samples (datasets/roughness.h); NaN without one, and in a
  // row that an earlier version wrote.
  double flat = std::numeric_limits<double>::quiet_NaN();
  double crease = std::numeric_limits<double>::quiet_NaN();

  int rejected() const { return samples - by_status[0]; }
};

// The row of a stage; nullptr when it is not there.
const StageStatistics* FindStage(const std::vector<StageStatistics>& rows, int stage);

// A mean divided by a reference mean, with the 95 % interval of the ratio (delta method for two
// independent means). This is kappa with c = 1 / reference (paper VI).
MeanInterval Ratio(const MeanInterval& value, const MeanInterval& reference);

// Kappa as a table for programs (docs/formats.md): the rows of StatisticsTable, with a half width
// for every mean; empty where there is no reference.
std::string KappaCsv(const std::vector<StageStatistics>& rows,
                     const std::vector<StageStatistics>& control);

// The table a person reads after a run: episode, samples, rejected by reason, graspability with its
// interval, kappa relative to the prior set, to episode 0 and to the control of the same episode
// ("-" without one), coverage, duplicates. `control` may be empty.
std::string StatisticsTable(const std::vector<StageStatistics>& rows,
                            const std::vector<StageStatistics>& control);

}  // namespace antigrasp
