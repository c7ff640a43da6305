#pragma once

#include <string>
#include <string_view>

namespace antigrasp {

// Text as HTML and XML show it, in an element or a quoted attribute: & < > " ' escaped.
std::string MarkupEscaped(std::string_view text);

}  // namespace antigrasp
