#pragma once

#include <string>
#include <string_view>

namespace antigrasp {

// Base 64 of RFC 4648, section 4: with padding, without line breaks.
std::string Base64(std::string_view bytes);

}  // namespace antigrasp
