#pragma once

#include <exception>
#include <string>
#include <utility>

#include "antigrasp/core/error.h"

namespace antigrasp {

enum ExitCode { kExitOk = 0, kExitFailure = 1, kExitBadInput = 2, kExitInterrupted = 130 };

// Another process of the job says why this one ends, too: no line, this exit code.
class SaidElsewhere : public std::exception {
 public:
  explicit SaidElsewhere(int exit_code) : exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }
  const char* what() const noexcept override { return "said by another process of the job"; }

 private:
  int exit_code_;
};

// An InputError whose line is there already.
class ToldInputError : public InputError {
 public:
  explicit ToldInputError(std::string line) : InputError("", "", ""), line_(std::move(line)) {}
  const char* what() const noexcept override { return line_.c_str(); }

 private:
  std::string line_;
};

// What a program ends with that fails with `error`.
int ExitCodeOf(const std::exception_ptr& error);

}  // namespace antigrasp
