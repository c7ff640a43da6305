#pragma once

#include <string>

namespace antigrasp {

// Throws std::logic_error with file, line, expression and message.
[[noreturn]] void CheckFailed(const char* file, int line, const char* expression,
                              const std::string& message);

}  // namespace antigrasp

// A broken invariant is a bug of ours: always on, in every build type.
#define AG_CHECK(condition, message)                                       \
  do {                                                                     \
    if (!(condition)) {                                                    \
      ::antigrasp::CheckFailed(__FILE__, __LINE__, #condition, (message)); \
    }                                                                      \
  } while (false)
