#include "antigrasp/train/control_run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/train/statistics_table.h"

namespace antigrasp {
namespace {

constexpr auto kLook = std::chrono::milliseconds(100);
// At a folder that another process has: the control of a run that was killed stops at its next
// report of progress.
constexpr int kLooks = 50;

bool HasThreads(const RunConfig& config) {
  return (config.threads > 0 ? config.threads : HardwareThreads()) > 1;
}

void Fork(const RunConfig& config, const RunFolder& run, const RunFolder& control) {
  RunConfig forked = config;
  forked.cem.select = EliteOrder::kRandom;
  forked.cem.refine_steps = 0;
  forked.cem.refine_niches = 0;
  forked.cem.refine_admits = 100.0;
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
    : config_(config), run_(run), starter_(starter), control_{run.Control()} {}

bool ControlRun::Done() const { return EpisodesDone(control_) == config_.cem.episodes + 1; }

bool ControlRun::BeginBeside() {
  // A program that scores may not be made to be there twice.
  const bool by_program = config_.cem.score.starts_with("judge:");
  if (!config_.cem.control || !starter_ || by_program || config_.device != "cpu" ||
      !HasThreads(config_)) {
    return false;
  }
  if (Done()) return true;
  {  // goes before the other process takes it
    const std::unique_ptr<RunLock> lock = Lock();
    if (lock == nullptr) return false;
    ForkUnlessBegun();
  }
  try {
    beside_ = starter_(control_.root);
  } catch (const RuntimeFailure& failure) {
    spdlog::warn("{}: the control run comes after this one", failure.what());
    return false;
  }
  spdlog::info("control run: the same on elites drawn at random, in a process beside this one");
  return true;
}

bool ControlRun::WaitForOther(RunObserver* observer) {
  if (beside_ == nullptr) return false;
  if (!beside_->Ended()) {
    const std::int64_t all = config_.cem.episodes + 1;
    const ProgressFn progress = observer->Phase("control run: its episodes");
    while (!beside_->Ended()) {
      progress(std::min(EpisodesDone(control_), all - 1), all);
      std::this_thread::sleep_for(kLook);
    }
    if (Done()) progress(all, all);
  }
  const std::string why = beside_->WhyEnded();
  beside_.reset();
  if (Done()) return true;
  spdlog::warn("the process of the control run ended early ({}): this one goes on with it",
               why.empty() ? "nobody knows why" : why);
  return false;
}

std::unique_ptr<RunLock> ControlRun::Lock() const {
  for (int look = 0; look < kLooks; ++look) {
    try {
      return std::make_unique<RunLock>(control_);
    } catch (const InputError&) {
      std::this_thread::sleep_for(kLook);
    }
  }
  return nullptr;
}

std::unique_ptr<RunLock> ControlRun::Begin() const {
  std::unique_ptr<RunLock> lock = Lock();
  if (lock == nullptr) lock = std::make_unique<RunLock>(control_);  // says who has it
  ForkUnlessBegun();
  return lock;
}

void ControlRun::ForkUnlessBegun() const {
  if (!control_.HoldsARun()) Fork(config_, run_, control_);
}

}  // namespace antigrasp
