#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/train/cem_run.h"

namespace antigrasp {

// What somebody asks of a run; what is empty was not asked for.
struct RunRequest {
  std::string config;                  // a configuration (TOML); without one, defaults
  std::string gripper;                 // ApplyGripper, before the settings
  std::vector<std::string> overrides;  // KEY=VALUE
  std::optional<std::uint64_t> seed;   // the others: over the settings
  std::optional<int> threads;
  std::string device, mode;
  std::string start;  // networks to begin with, which also say model.* before all else
  bool fine_tune = false;
  bool from_scratch = false;  // no networks to begin with
};

// --set takes every word up to the next option, so also a configuration that stands behind the
// settings: the first of the overrides that is no KEY=VALUE becomes it, when there is no other.
void TakeConfigFromSettings(RunRequest* request);

// The settings that this comes to. InputError for what is unknown, out of range or does not fit.
RunConfig ConfigOf(const RunRequest& request);

// What becomes of a run that `folder` already holds.
enum class OldRun {
  kRefuse,
  kGoOn,    // InputError when it was started with other settings
  kReplace  // once nothing speaks against the new one's inputs
};
RunResult StartRun(const RunConfig& config, const std::filesystem::path& folder, OldRun old_run,
                   RunObserver* observer, const RunParts& parts = {},
                   const ShapeModelMaker& make = MakeGan);

}  // namespace antigrasp
