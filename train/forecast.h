#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <string>

#include "antigrasp/train/run_config.h"

namespace antigrasp {

// How long a run will take, from what its first updates and its first stage took. Nothing but what
// is told a person depends on it.
struct Pace {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  double update = kUnknown;  // seconds of one
  double stage = kUnknown;   // seconds of sampling, remeshing and scoring one episode's objects
};

// GAN updates of an episode; 0 where the networks stay as they are.
std::int64_t UpdatesOf(const RunConfig& config, int episode);

// Seconds from the beginning of an episode to the end of the run, its control included. NaN when
// that has a part of unknown pace.
double SecondsLeft(const RunConfig& config, const Pace& pace, int episode);

// Lines for a person: the updates of this run and of one of the paper's size; what is left.
std::string TrainingForecast(const RunConfig& config, double seconds_per_update);
std::string RunForecast(const RunConfig& config, const Pace& pace, int next_episode);

// Takes the time of the first updates of a process, without the two that warm caches up.
class UpdateTimer {
 public:
  // After every update. True once, when `seconds` is known.
  bool Tick();
  double seconds() const { return seconds_; }

 private:
  static constexpr int kWarmUp = 2, kTimed = 8;
  std::chrono::steady_clock::time_point began_;
  int updates_ = 0;
  double seconds_ = Pace::kUnknown;
};

}  // namespace antigrasp
