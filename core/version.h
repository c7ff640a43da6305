#pragma once

#include <string>

namespace antigrasp {

std::string ProgramVersion();  // "0.1.0"
std::string ProgramCommit();   // "990fc1c", "990fc1c-dirty"; empty when built outside of git

}  // namespace antigrasp
