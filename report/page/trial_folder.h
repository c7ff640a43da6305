#pragma once

#include <map>
#include <string>
#include <vector>

#include "antigrasp/report/page/report.h"

namespace antigrasp {

using TrialsByObject = std::map<std::string, ReportTrials>;

// The trials of folders: trials.csv, executions.csv and, where it is there, replays.json
// (docs/formats.md, "Replays"). InputError for a folder without the tables, a file that is not as
// it should be, or an object that was tried twice under the same conditions.
TrialsByObject ReadTrials(const std::vector<std::string>& folders);

// Puts them beside the objects of the same names. What has no partner is a sentence of
// report->missing.
void AddTrials(const TrialsByObject& trials, Report* report);

}  // namespace antigrasp
