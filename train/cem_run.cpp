#include "antigrasp/train/cem_run.h"

#include <spdlog/spdlog.h>
#include <torch/types.h>

#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/cem_loop.h"
#include "antigrasp/train/control_run.h"
#include "antigrasp/train/episode_loop.h"
#include "antigrasp/train/provenance.h"
#include "antigrasp/train/run_inputs.h"
#include "antigrasp/train/run_lock.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// The prior set's network values; the set itself goes to the folder, unless it is unusable.
torch::Tensor MakePrior(const RunConfig& config, const RunFolder& run, const PriorMaker& make,
                        RunObserver* observer) {
  const ShapeSet set = PriorOf(config, observer, make);
  torch::Tensor values = NetworkValuesOf(set, config.model, config.prior_file);
  WriteShapeSet(run.Prior(), set);
  return values;
}

void RequireNoRun(const RunFolder& run) {
  if (!run.HoldsARun()) return;
  throw InputError("a run is already there", run.root.string(),
                   "a new folder, --resume to go on, or --overwrite to start again");
}

// nullptr: the graspability scores.
std::unique_ptr<Judge> JudgeFor(const RunConfig& config, const RunParts& parts) {
  if (RefinesMeshes(config.cem) && !parts.refine) {
    throw InputError("nobody refines elites for cem.refine_steps", "configuration", "0");
  }
  if (config.cem.score == kEpsilonScore) return nullptr;
  if (parts.make_judge) return parts.make_judge(config);
  throw InputError("no judge for cem.score = " + config.cem.score, "configuration", kEpsilonScore);
}

// What a process that nobody hears would have said of its episodes.
void SayStages(const std::vector<StageStatistics>& rows) {
  for (const StageStatistics& row : rows) {
    if (row.stage < 0) continue;
    LogStage(row, rows);
    WarnIfCollapsed(row, rows);
  }
}

RunResult Finish(const RunConfig& config, const RunFolder& folder, const torch::Tensor& prior,
                 ProvenanceRecorder* recorder, const ShapeModelMaker& make, Judge* judge,
                 const RunParts& parts) {
  const auto scorer = [&](const RunConfig& of) {
    if (parts.make_scorer) return parts.make_scorer(of, judge, recorder);
    return judge != nullptr ? JudgedScorer(of, judge, recorder) : GraspabilityScorer(of, recorder);
  };
  ControlRun control(config, folder, parts.run_beside);
  RunResult result;
  result.stages = RunEpisodes(config, folder, make(config).get(), prior, scorer(config), recorder,
                              parts.refine, [&] { return control.BeginBeside(); });
  if (config.cem.control) {
    const bool made = control.WaitForOther(recorder);
    const std::unique_ptr<RunLock> lock = control.Begin();
    if (!made) spdlog::info("control run: the same on elites drawn at random");
    const RunConfig forked = ConfigOfRun(control.folder().root);
    result.control =
        RunEpisodes(forked, control.folder(), make(forked).get(), prior, scorer(forked), recorder);
    if (made) SayStages(result.control);
  }
  recorder->Finish();
  if (judge == nullptr) return result;
  for (const std::string& note : judge->Notes()) spdlog::warn("judge: {}", note);
  return result;
}

}  // namespace

RunConfig ConfigOfRun(const fs::path& folder) {
  const RunFolder run{folder};
  RequireFile(run.Config(), "the config.toml of a run");
  const RunConfig config = FromToml(ReadFile(run.Config()), run.Config().string());
  Validate(config, run.Config().string());
  return config;
}

RunResult StartRun(const RunConfig& config, const fs::path& folder, RunObserver* observer,
                   const ShapeModelMaker& make, const RunParts& parts) {
  const RunFolder run{folder};
  RequireNoRun(run);
  Validate(config, "configuration");
  RequireFittingStart(config);
  make(config);  // refuses a device that is not there, first
  const std::unique_ptr<Judge> judge = JudgeFor(config, parts);
  const RunLock lock(run);
  RequireNoRun(run);   // that another process has begun and left
  MakeFolder(folder);  // it is there: refuses one that cannot be written to, before the work
  ProvenanceRecorder recorder(run, ProvenanceNow(config), observer);
  const torch::Tensor prior = MakePrior(config, run, parts.make_prior, &recorder);
  WriteFileAtomic(run.Config(), ToToml(config));
  return Finish(config, run, prior, &recorder, make, judge.get(), parts);
}

void RequireInputs(const RunConfig& config, const fs::path& folder) {
  const std::string root = (fs::weakly_canonical(folder) / "").string();
  const auto require_outside = [&](const fs::path& path) {
    if (!fs::weakly_canonical(path).string().starts_with(root)) return;
    throw InputError("lies in the run that is to be overwritten", path.string(),
                     "a copy elsewhere");
  };
  Validate(config, "configuration");
  if (!config.prior_file.empty()) {
    ReadShapeSetInfo(config.prior_file);
    require_outside(config.prior_file);
  }
  RequireFittingStart(config);
  if (!config.start.empty()) require_outside(FindNetworks(config.start));
}

RunResult ResumeRun(const fs::path& folder, RunObserver* observer, const ShapeModelMaker& make,
                    const RunParts& parts) {
  const RunFolder run{folder};
  const RunConfig config = ConfigOfRun(folder);
  const std::unique_ptr<Judge> judge = JudgeFor(config, parts);
  const RunLock lock(run);
  ProvenanceRecorder recorder(run, ReadProvenance(run), observer);
  const torch::Tensor prior =
      NetworkValuesOf(ReadShapeSet(run.Prior()), config.model, run.Prior().string());
  return Finish(config, run, prior, &recorder, make, judge.get(), parts);
}

}  // namespace antigrasp
