#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "antigrasp/core/parallel.h"

namespace antigrasp::python {

namespace py = pybind11;

// Makes our exceptions those of antigrasp/_errors.py, each with its one line: InputError is
// antigrasp.InputError, RuntimeFailure antigrasp.Error, Interrupted KeyboardInterrupt. Of this
// module alone, whatever others are loaded.
void TranslateErrors();

// Says so by Python's warnings, as antigrasp.Warning. Needs the GIL; throws where the user wants
// warnings to be errors.
void Warn(const std::string& text);

// For work without the GIL: takes it now and then to see whether Ctrl-C was pressed, and then
// throws what Python's handler raises. Of the main thread only, as Python has it.
ProgressFn ListenToPython();
void ThrowIfPythonWasInterrupted();

}  // namespace antigrasp::python
