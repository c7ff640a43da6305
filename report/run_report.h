#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/report_settings.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/run_folder.h"

namespace antigrasp {

// The page of a run: the charts of its tables and a gallery of every stage. Any part of the folder
// may be missing. `make`: the shape model that the run was started with.
Report RunReport(const RunFolder& run, const ReportSettings& settings, RunObserver* observer,
                 const ShapeModelMaker& make = MakeGan);

// Whether the folder holds a run, or what is left of one.
bool IsRun(const std::string& path);

}  // namespace antigrasp
