#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/quality/score_table.h"
#include "antigrasp/train/loss_table.h"
#include "antigrasp/train/provenance.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/statistics.h"

namespace antigrasp {

// What a run's folder says of one stage.
struct StageRecord {
  int episode = -1;                             // -1: the prior set
  std::optional<StageStatistics> row;           // of statistics.csv
  std::optional<std::vector<ScoreRow>> scores;  // row i is sample i
  std::optional<LossTable> losses;              // none of the prior set
};

// By sample, NaN for one that is no usable object; nothing of a stage without scores.
std::vector<double> GraspabilitiesOf(const StageRecord* stage);

// A run's folder as a value: its tables and what it says of itself. Any part of the folder may be
// missing. Networks and grids stay where they are.
struct RunRecord {
  RunFolder folder;
  std::string config_toml;               // config.toml as it is
  std::optional<RunConfig> config;       // read as NetworksFromToml does; none without the file
  std::optional<Provenance> provenance;  // none without the file
  bool has_statistics = false;           // the file is there
  std::vector<StageRecord> stages;       // of which anything is there, ascending

  const StageRecord* Find(int episode) const;  // nullptr: nothing of it is there
};

// The folder of a run or of its control. InputError with file:line for a damaged table.
RunRecord ReadRun(const std::filesystem::path& folder);

// The rows of the stages that are finished: those of the last checkpoint, which knows of a scored
// prior set before statistics.csv does; of statistics.csv where only the tables were kept; none
// without either.
std::vector<StageStatistics> LatestStatistics(const RunFolder& run);

}  // namespace antigrasp
