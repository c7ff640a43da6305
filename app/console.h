#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "antigrasp/core/observer.h"

namespace antigrasp {

// Ctrl-C and SIGTERM set a flag; a second one ends the process at once.
void InstallSignalHandlers();
bool InterruptRequested();

// Progress on standard error: one line that rewrites itself on a terminal, a line every ten seconds
// elsewhere. Shows share, rate, time left and the loop's own detail. Throws Interrupted from the
// progress function once a signal came.
class ConsoleObserver : public RunObserver {
 public:
  ConsoleObserver();
  ProgressFn Phase(const std::string& label) override;
  void Detail(const std::string& text) override;
  void Note(const std::string& text) override;
  bool StopRequested() const override;

 private:
  struct Bar;
  std::shared_ptr<Bar> bar_;
};

void ThrowIfInterrupted();

// A warning in the log.
void Warn(const std::string& text);

}  // namespace antigrasp
