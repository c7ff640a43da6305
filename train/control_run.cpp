#include "antigrasp/train/control_run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/train/run_lock.h"
#include "antigrasp/train/statistics_table.h"

namespace antigrasp {
namespace {

bool HasThreads(const RunConfig& config) {
  return (config.threads > 0 ? config.threads : HardwareThreads()) > 1;
}

void Fork(const RunConfig& config, const RunFolder& run, const RunFolder& control) {
  RunConfig forked = config;
  forked.cem.select = EliteOrder::kRandom;
  forked.cem.refine_steps = 0;
  forked.cem.refine_niches = 0;
  forked.cem.control = false;
  forked.stl_count = 0;
  WriteFileAtomic(control.Prior(), ReadFile(run.Prior()));
  Checkpoint checkpoint = ReadCheckpoint(run.EpisodeCheckpoint(0));
  checkpoint.config = ToToml(forked);
  WriteCheckpoint(control.Latest(), checkpoint);
  // Last: a folder with a configuration holds a run.
  WriteFileAtomic(control.Config(), checkpoint.config);
}

// Episodes in the control's table, as far as it is written.
std::int64_t EpisodesDone(const RunFolder& control) {
  if (!std::filesystem::exists(control.Statistics())) return 0;
  const auto rows = ReadStatistics(control.Statistics());
  return std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.stage >= 0; });
}

}  // namespace

ControlRun::ControlRun(const RunConfig& config, const RunFolder& run, const BesideStarter& starter)
    : config_(config), run_(run), starter_(starter) {}

void ControlRun::BeginBeside() {
  // A program that scores may not be made to be there twice.
  const bool by_program = config_.cem.score.starts_with("judge:");
  if (!config_.cem.control || !config_.control_beside || !starter_ || by_program ||
      config_.device != "cpu" || !HasThreads(config_)) {
    return;
  }
  const RunFolder control{run_.Control()};
  try {
    const RunLock lock(control);
    Begin();
  } catch (const InputError&) {  // another process is at it still: left for later
    return;
  }
  spdlog::info("control run: the same on elites drawn at random, in a process beside this one");
  beside_ = starter_(control.root);
}

bool ControlRun::WaitForOther(RunObserver* observer) {
  if (beside_ == nullptr) return false;
  const RunFolder control{run_.Control()};
  const std::int64_t all = config_.cem.episodes + 1;
  if (!beside_->Ended()) {
    const ProgressFn progress = observer->Phase("control run: its episodes");
    while (!beside_->Ended()) {
      progress(std::min(EpisodesDone(control), all - 1), all);
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    if (EpisodesDone(control) == all) progress(all, all);
  }
  beside_.reset();
  return EpisodesDone(control) == all;
}

RunFolder ControlRun::Begin() const {
  const RunFolder control{run_.Control()};
  if (!control.HoldsARun()) Fork(config_, run_, control);
  return control;
}

}  // namespace antigrasp
