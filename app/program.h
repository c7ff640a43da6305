#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

namespace antigrasp {

// What main() is for `antigrasp` and `antigrasp-networks` alike: logging, signals, the commands
// that `add_commands` adds and `help`, and the exit code of what they throw (docs/architecture.md),
// whose line is printed where `says` has nothing against it.
using SaysFn = std::function<bool(int exit_code, const std::string& line)>;
int RunProgram(int argc, char** argv, const std::function<void(CLI::App*)>& add_commands,
               const SaysFn& says = nullptr);

}  // namespace antigrasp
