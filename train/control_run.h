#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/run_lock.h"

namespace antigrasp {

// A run that another process goes on with, until its end or until this goes.
class RunBeside {
 public:
  virtual ~RunBeside() = default;
  virtual bool Ended() = 0;                  // at the run's end or for another reason
  virtual std::string WhyEnded() const = 0;  // "exit code 1", "signal 9 (Killed)"; "" for neither
};

// Goes on with the run in `folder` by its own configuration. RuntimeFailure where that cannot be.
using BesideStarter =
    std::function<std::unique_ptr<RunBeside>(const std::filesystem::path& folder)>;

// The control of a run, RUN/control: a run folder of its own that begins where the run ended
// episode 0, with the same networks and the same prior set, and keeps elites at random. It depends
// on nothing that comes after episode 0, so that another process can go on with it while the run
// itself does; its bytes are the same either way.
class ControlRun {
 public:
  // All are kept and must live as long as this. starter: may be empty.
  ControlRun(const RunConfig& config, const RunFolder& run, const BesideStarter& starter);

  // Episode 0 is trained: begins the control and hands it to another process, where there is a
  // starter, the networks are on the CPU, it is not for one thread, no program scores and nobody is
  // at it. Whether another process goes on with it, or has done so.
  bool BeginBeside();
  // Waits for that process, if there is one: whether all episodes are made. What is not is left to
  // do.
  bool WaitForOther(RunObserver* observer);
  // The right to write to the folder, which is begun where it is not. Waits some seconds for a
  // process that is about to stop, then InputError.
  std::unique_ptr<RunLock> Begin() const;
  const RunFolder& folder() const { return control_; }

 private:
  std::unique_ptr<RunLock> Lock() const;  // nullptr: another process keeps it
  void ForkUnlessBegun() const;
  bool Done() const;

  const RunConfig& config_;
  const RunFolder& run_;
  const BesideStarter& starter_;
  RunFolder control_;
  std::unique_ptr<RunBeside> beside_;
};

}  // namespace antigrasp
