#pragma once

#include <string>
#include <utility>
#include <vector>

#include "antigrasp/report/page/report.h"

namespace antigrasp {

// The executions of a replays.json (docs/formats.md, "Replays"), each with the name of its object,
// in the file's order. InputError with the place for anything that is not as the document says: the
// page relies on it.
std::vector<std::pair<std::string, ReportReplay>> ReadReplays(const std::string& path);

}  // namespace antigrasp
