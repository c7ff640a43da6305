#include "antigrasp/train/forecast.h"

#include <cstdio>

#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

// Of what follows episode 0, which a run and its control both go through.
std::int64_t LaterUpdates(const RunConfig& config) {
  std::int64_t updates = 0;
  for (int episode = 1; episode <= config.cem.episodes; ++episode) {
    updates += UpdatesOf(config, episode);
  }
  return updates;
}

double Cost(std::int64_t count, double seconds) {
  return count == 0 ? 0.0 : static_cast<double>(count) * seconds;
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

std::int64_t UpdatesOf(const RunConfig& config, int episode) {
  if (episode > 0) return config.cem.mode == EpisodeMode::kLatent ? 0 : config.cem.iterations;
  return config.start.empty() || config.fine_tune ? config.cem.prior_iterations : 0;
}

double SecondsLeft(const RunConfig& config, const Pace& pace, int episode) {
  std::int64_t updates = 0, stages = 0;
  for (int e = episode; e <= config.cem.episodes; ++e) {
    updates += UpdatesOf(config, e);
    ++stages;
  }
  if (config.cem.control) {  // it samples the networks of episode 0 itself
    updates += LaterUpdates(config);
    stages += config.cem.episodes + 1;
  }
  return Cost(updates, pace.update) + Cost(stages, pace.stage);
}

std::string TrainingForecast(const RunConfig& config, double seconds_per_update) {
  const auto time = [&](std::int64_t updates) {
    return FormatDuration(Cost(updates, seconds_per_update));
  };
  const auto part = [&](const std::string& what, std::int64_t updates) {
    return what + " " + time(updates) + " (" + std::to_string(updates) + ")";
  };
  const std::int64_t first = UpdatesOf(config, 0), later = LaterUpdates(config);
  const CemOptions paper;  // the defaults are its numbers
  const std::int64_t of_paper =
      paper.prior_iterations + std::int64_t{paper.episodes} * paper.iterations;
  std::string line = "an update takes " + Number(seconds_per_update) + "s";
  if (first > 0) line += part(", those of episode 0", first);
  if (later > 0) line += part(", of each later one", UpdatesOf(config, 1));
  line += part(", of the whole run", first + (config.cem.control ? 2 : 1) * later);
  line += config.cem.control && later > 0 ? " with its control" : "";
  return line + part("; as many as the paper's, with these networks,", of_paper);
}

std::string RunForecast(const RunConfig& config, const Pace& pace, int next_episode) {
  return "sampling and scoring " + std::to_string(config.cem.samples) + " objects took " +
         FormatDuration(pace.stage) + ": about " +
         FormatDuration(SecondsLeft(config, pace, next_episode)) + " to the end of the run";
}

bool UpdateTimer::Tick() {
  if (updates_ == kWarmUp + kTimed) return false;
  ++updates_;
  const auto now = std::chrono::steady_clock::now();
  if (updates_ == kWarmUp) began_ = now;
  if (updates_ < kWarmUp + kTimed) return false;
  seconds_ = std::chrono::duration<double>(now - began_).count() / kTimed;
  return true;
}

}  // namespace antigrasp
