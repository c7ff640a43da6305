#pragma once

#include <CLI/App.hpp>
#include <functional>

namespace antigrasp {

// What main() is for `antigrasp` and `antigrasp-networks` alike: logging, signals, the commands
// that `add_commands` adds and `help`, and the exit code of what they throw (docs/architecture.md).
int RunProgram(int argc, char** argv, const std::function<void(CLI::App*)>& add_commands);

}  // namespace antigrasp
