#include "antigrasp/core/check.h"

#include <stdexcept>

namespace antigrasp {

void CheckFailed(const char* file, int line, const char* expression, const std::string& message) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": CHECK " + expression +
                         " failed: " + message);
}

}  // namespace antigrasp
