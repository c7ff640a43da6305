#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>

#include "antigrasp/quality/judge.h"

namespace antigrasp::python {

// A function of Python as judge: called with an antigrasp.Mesh, one at a time, and answers with a
// number, lower = harder to grasp, or with None for no score. What it raises ends the work and is
// raised where that was called; so is InputError for any other answer. Made by `make` as often as
// there are objects at work; it may be made and go without the GIL.
std::function<std::unique_ptr<Judge>()> JudgeOfFunction(const pybind11::object& function);

}  // namespace antigrasp::python
