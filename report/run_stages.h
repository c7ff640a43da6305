#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/quality/score_table.h"
#include "antigrasp/report/page/report.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"

namespace antigrasp {

// What a run's tables say of its stages, for the charts and for the choice of the gallery.
struct RunTables {
  ReportRun run;
  std::map<int, std::vector<ScoreRow>> scores;  // by stage, -1 = prior set; of the run itself
};

// statistics.csv, prior_scores.csv, episode_K/scores.csv and losses.csv of the run and of its
// control's episodes after 0 (before, both are one). Stages without a row in statistics.csv get
// their counts and mean from their scores. What is not there becomes a sentence in `missing`;
// `config` (nullptr: unknown) says how many episodes there should be. InputError with file:line for
// a damaged table.
RunTables ReadRunTables(const RunFolder& run, const RunConfig* config,
                        std::vector<std::string>* missing);

}  // namespace antigrasp
