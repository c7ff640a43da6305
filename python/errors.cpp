#include "antigrasp/python/errors.h"

#include <chrono>

#include "antigrasp/core/error.h"

namespace antigrasp::python {
namespace {

py::object OfPackage(const char* name) {
  return py::module_::import("antigrasp._errors").attr(name);
}

void Raise(const char* name, const std::exception& error) {
  PyErr_SetString(OfPackage(name).ptr(), error.what());
}

}  // namespace

void TranslateErrors() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      Raise("InputError", error);
    } catch (const RuntimeFailure& error) {
      Raise("Error", error);
    } catch (const Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
}

void Warn(const std::string& text) {
  if (PyErr_WarnEx(OfPackage("Warning").ptr(), text.c_str(), 2) != 0) throw py::error_already_set();
}

void ThrowIfPythonWasInterrupted() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kBetween(20);  // asked after every item, however small
  static thread_local Clock::time_point asked;
  if (Clock::now() - asked < kBetween) return;
  asked = Clock::now();
  const py::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

ProgressFn ListenToPython() {
  return [](std::int64_t, std::int64_t) { ThrowIfPythonWasInterrupted(); };
}

}  // namespace antigrasp::python
