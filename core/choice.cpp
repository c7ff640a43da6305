#include "antigrasp/core/choice.h"

namespace antigrasp {

std::string Alternatives(const std::vector<std::string>& names, const std::string& prefix) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += prefix + names[i];
  }
  return text;
}

}  // namespace antigrasp
