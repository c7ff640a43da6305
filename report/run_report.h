#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/report_settings.h"
#include "antigrasp/train/run_folder.h"

namespace antigrasp {

// The page of a run: the charts of its tables and a gallery of every stage. Any part of the folder
// may be missing.
Report RunReport(const RunFolder& run, const ReportSettings& settings, RunObserver* observer);

// Whether the folder holds a run, or what is left of one.
bool IsRun(const std::string& path);

}  // namespace antigrasp
