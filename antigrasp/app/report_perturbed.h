#pragma once

#include "antigrasp/app/report_settings.h"
#include "antigrasp/train/run_observer.h"

namespace antigrasp {

// The page of a folder that `perturb` wrote: every object after and before, its similarity numbers
// and, evaluated again with the folder's metric and seed, its grasps.
Report PerturbedReport(const std::string& folder, const ReportSettings& settings,
                       RunObserver* observer);

bool IsPerturbed(const std::string& path);  // a folder with perturb.csv

}  // namespace antigrasp
