#pragma once

#include <string>

#include "antigrasp/core/parallel.h"

namespace antigrasp {

// How a run shows what it does and hears that it should stop. The application draws bars; tests
// count calls.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  // A new piece of work a person waits for. The returned function may throw Interrupted.
  virtual ProgressFn Phase(const std::string& label) = 0;
  // Shown beside the current bar ("L_D 1.93  L_G 0.12").
  virtual void Detail(const std::string& text) = 0;
  // A line that stays, above the bar.
  virtual void Note(const std::string&) {}
  virtual bool StopRequested() const = 0;
};

// A phase without a label is not shown.
inline ProgressFn PhaseOf(RunObserver* observer, const std::string& label) {
  return label.empty() ? ProgressFn() : observer->Phase(label);
}

// For work that nobody watches: shows nothing, never stops.
class SilentObserver : public RunObserver {
 public:
  ProgressFn Phase(const std::string&) override {
    return [](std::int64_t, std::int64_t) {};
  }
  void Detail(const std::string&) override {}
  bool StopRequested() const override { return false; }
};

}  // namespace antigrasp
