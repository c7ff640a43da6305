#pragma once

#include <string>
#include <vector>

#include "antigrasp/trial/model_trial.h"

namespace antigrasp {

// The trials of all objects under one reading of the friction angle.
struct TrialReading {
  FrictionReading reading;
  double friction;
  std::vector<TrialResult> results;  // one an object
};

// The table of `trial` (docs/trials.md): a row for every object and reading.
std::string TrialCsv(const std::vector<std::string>& objects,
                     const std::vector<TrialReading>& readings);

// The same for the eye, in percent of the grasps.
std::string TrialText(const std::vector<std::string>& objects,
                      const std::vector<TrialReading>& readings, double min_epsilon);

}  // namespace antigrasp
