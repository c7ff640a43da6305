#pragma once

#include <stdexcept>
#include <string>

namespace antigrasp {

// A file, flag, configuration value or input that the user can correct. Thrown at the boundary,
// caught once in main(), printed as one line, exit code 2.
// `what` names the thing and its value, `where` the file (or file:line, or flag), `expected` what
// would have been accepted: "friction = -1 (demo.toml:12): expected a number in [0, 10]".
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& what, const std::string& where, const std::string& expected)
      : std::runtime_error(what + " (" + where + "): expected " + expected) {}
};

// The machine failed us (disk full, rename refused, allocation of a device): exit code 1.
class RuntimeFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Ctrl-C or SIGTERM, thrown by progress callbacks after the flag was seen: exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace antigrasp
