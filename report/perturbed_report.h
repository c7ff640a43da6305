#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/report_settings.h"

namespace antigrasp {

// The page of a folder that `perturb` wrote: every object after and before, how it changed
// and, evaluated again with the folder's metric and seed, its grasps.
Report PerturbedReport(const std::string& folder, const ReportSettings& settings,
                       RunObserver* observer);

bool IsPerturbed(const std::string& path);  // a folder with perturb.csv

}  // namespace antigrasp
