#pragma once

#include <map>
#include <string>

#include "antigrasp/report/page/report.h"

namespace antigrasp {

using TrialsByObject = std::map<std::string, ReportTrials>;

// The trials of a folder: trials.csv, executions.csv and, where it is there, replays.json
// (docs/formats.md, "Replays"). InputError for a folder without the tables, or a file that is not
// as it should be.
TrialsByObject ReadTrials(const std::string& folder);

// Puts them beside the objects of the same names. What has no partner is a sentence of
// report->missing, which names the folder.
void AddTrials(const TrialsByObject& trials, const std::string& folder, Report* report);

}  // namespace antigrasp
