#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/report_settings.h"

namespace antigrasp {

// The report of a run, of a folder that `perturb` wrote, or of any objects. Run and folder have a
// metric of their own and fill a page alone: InputError beside other inputs, and with
// `metric_given`, when somebody asked for constants or a seed.
Report MakeReport(const ReportSettings& settings, bool metric_given, RunObserver* observer);

}  // namespace antigrasp
