#pragma once

#include <string>
#include <vector>

#include "antigrasp/report/page/report.h"
#include "antigrasp/train/run_record.h"

namespace antigrasp {

// What a run's tables say of its stages and of its control's episodes after 0 (before, both are
// one), for the charts. Stages without a row in statistics.csv get their counts and mean from their
// scores. What is not there becomes a sentence in `missing`; the configuration says how many
// episodes there should be.
ReportRun StagesOf(const RunRecord& run, std::vector<std::string>* missing);

}  // namespace antigrasp
