#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/page/report.h"

namespace antigrasp {

// Checks every object that has a surface for printing with its largest extent at `size_mm`, as
// `export` does.
void AddPrintChecks(double size_mm, int threads, RunObserver* observer, Report* report);

}  // namespace antigrasp
