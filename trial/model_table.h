#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/trial/model_trial.h"

namespace antigrasp {

// The trials of all objects under one reading of the friction angle.
struct TrialReading {
  FrictionReading reading;
  double friction;
  std::vector<TrialResult> results;  // one an object
};

// Of one reading, or of all.
std::vector<TrialReading> RunReadings(const std::vector<InputObject>& objects,
                                      std::optional<FrictionReading> chosen, double angle_degrees,
                                      MetricOptions metric, const TrialOptions& options,
                                      std::uint64_t seed, int threads, RunObserver* observer);

// The table of `trial` (docs/trials.md): a row for every object and reading.
std::string TrialCsv(const std::vector<std::string>& objects,
                     const std::vector<TrialReading>& readings);

// What stands beside the table before the options: seed, angle and reading, as TOML.
std::string ModelTrialToml(std::uint64_t seed, double friction_angle, const std::string& reading);

// The same for the eye, in percent of the grasps.
std::string TrialText(const std::vector<std::string>& objects,
                      const std::vector<TrialReading>& readings, double min_epsilon);

}  // namespace antigrasp
