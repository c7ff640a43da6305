#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"

namespace antigrasp {

// A run that another process goes on with, until its end or until this goes.
class RunBeside {
 public:
  virtual ~RunBeside() = default;
  virtual bool Ended() = 0;  // at the run's end or for another reason
};

// Goes on with the run in `folder` by its own configuration.
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

  // Episode 0 is trained: hands the control to another process, where there is a starter,
  // run.control_beside, a processor and more than one thread, and no program scores.
  void BeginBeside();
  // Waits for that process, if there is one: whether it has made all episodes. What it has not done
  // is left to do.
  bool WaitForOther(RunObserver* observer);
  // The folder, begun where it is not.
  RunFolder Begin() const;

 private:
  const RunConfig& config_;
  const RunFolder& run_;
  const BesideStarter& starter_;
  std::unique_ptr<RunBeside> beside_;
};

}  // namespace antigrasp
