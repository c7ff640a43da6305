#include "antigrasp/core/version.h"

namespace antigrasp {

std::string ProgramVersion() { return ANTIGRASP_VERSION; }
std::string ProgramCommit() { return ANTIGRASP_COMMIT; }

}  // namespace antigrasp
