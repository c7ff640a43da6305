#pragma once

#include <string_view>

namespace antigrasp {

// The page without data: what npm made of viewer/, built into the program.
std::string_view ReportTemplate();

}  // namespace antigrasp
