#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

// The name that `word` was most likely meant to be: the fewest letters changed, left out, put in or
// exchanged with a neighbour; of several the first. Empty when there are no names.
std::string Nearest(std::string_view word, const std::vector<std::string>& names);

}  // namespace antigrasp
