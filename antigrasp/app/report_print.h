#pragma once

#include "antigrasp/report/report.h"
#include "antigrasp/train/run_observer.h"

namespace antigrasp {

// Checks every object that has a surface for printing with its largest extent at `size_mm`, as
// `export` does.
void AddPrintChecks(double size_mm, int threads, RunObserver* observer, Report* report);

}  // namespace antigrasp
