#include "antigrasp/train/run_request.h"

#include <algorithm>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/error.h"
#include "antigrasp/quality/named_gripper.h"

namespace antigrasp {
namespace {

// What a run that begins with these networks has for model.* if it does not say otherwise.
ModelOptions ModelOf(const std::string& networks) {
  const std::filesystem::path path = FindNetworks(networks);
  return NetworksFromToml(ReadCheckpoint(path).config, path.string()).model;
}

}  // namespace

void TakeConfigFromSettings(RunRequest* request) {
  const auto config = std::find_if(request->overrides.begin(), request->overrides.end(),
                                   [](const std::string& word) {
                                     const std::size_t equals = word.find('=');
                                     return equals == std::string::npos || word.find('/') < equals;
                                   });
  if (config == request->overrides.end() || !request->config.empty()) return;
  request->config = *config;
  request->overrides.erase(config);
}

RunConfig ConfigOf(const RunRequest& request) {
  RunConfig config;
  OptionTable table;
  Bind(&table, &config);
  if (!request.start.empty()) config.model = ModelOf(request.start);
  if (!request.config.empty()) table.ApplyFile(request.config);
  if (!request.gripper.empty()) ApplyGripper(request.gripper, &config.metric);
  for (const std::string& text : request.overrides) table.ApplyOverride(text);
  if (request.seed) config.seed = *request.seed;
  if (request.threads) {
    table.ApplyValue("run.threads", std::to_string(*request.threads), "--threads");
  }
  if (!request.device.empty()) config.device = request.device;
  if (!request.mode.empty()) table.ApplyValue("cem.mode", request.mode, "--mode");
  if (!request.start.empty()) config.start = request.start;
  if (request.fine_tune) config.fine_tune = true;
  if (request.from_scratch) {
    config.start.clear();
    config.fine_tune = false;
  }
  const std::string origin = request.config.empty() ? "configuration" : request.config;
  Validate(config, origin);
  RequireFittingGripper(config.metric, origin);
  return config;
}

RunResult StartRun(const RunConfig& config, const std::filesystem::path& folder, OldRun old_run,
                   RunObserver* observer, const RunParts& parts, const ShapeModelMaker& make) {
  const RunFolder run{folder};
  if (old_run == OldRun::kGoOn && run.HoldsARun()) {
    if (ToToml(ConfigOfRun(run.root)) != ToToml(config)) {
      throw InputError("the run in " + folder.string() + " was started with other settings",
                       run.Config().string(), "the same settings, --overwrite or another --out");
    }
    return ResumeRun(run.root, observer, make, parts);
  }
  if (old_run == OldRun::kReplace && run.HoldsARun()) {
    RequireInputs(config, run.root);  // what is refused costs no run
    run.Remove();
  }
  return StartRun(config, folder, observer, make, parts);
}

}  // namespace antigrasp
