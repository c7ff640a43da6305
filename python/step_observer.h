#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "antigrasp/core/observer.h"
#include "antigrasp/python/errors.h"

namespace antigrasp::python {

// What a run tells goes to a function of Python, (what, done, of), or to nobody; Ctrl-C is heard
// where progress is told.
class StepObserver : public RunObserver {
 public:
  explicit StepObserver(const pybind11::object& function)
      : function_(new pybind11::object(function), [](pybind11::object* held) {
          const pybind11::gil_scoped_acquire lock;
          delete held;
        }) {}

  ProgressFn Phase(const std::string& label) override {
    if (function_->is_none()) return ListenToPython();
    return [function = function_, label](std::int64_t done, std::int64_t of) {
      ThrowIfPythonWasInterrupted();
      const pybind11::gil_scoped_acquire held;
      (*function)(label, done, of);
    };
  }
  void Detail(const std::string&) override {}
  void Note(const std::string& text) override {
    const pybind11::gil_scoped_acquire held;
    Warn(text);
  }
  bool StopRequested() const override { return false; }

 private:
  std::shared_ptr<pybind11::object> function_;
};

}  // namespace antigrasp::python
