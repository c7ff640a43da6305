#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/report_settings.h"

namespace antigrasp {

// Meshes, folders of meshes, SDF files and score tables of `evaluate`: one group an input. Objects
// are scored now, object i from the stream of number i as `evaluate` of the same inputs does. With
// one table beside them its constants and seed are used, and an object draws from the stream of its
// row: the scores agree. Tables alone are shown as they are, without meshes.
Report ObjectsReport(const ReportSettings& settings, RunObserver* observer);

// A CSV with scores in it, by its first line; false for anything else.
bool IsScoreTable(const std::string& path);

}  // namespace antigrasp
