#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/report/report.h"

namespace antigrasp {

// A row of scores.csv, of `evaluate` or of a run's stage.
struct ScoreRow {
  std::string object, status;
  std::optional<ReportScore> score;  // none for an object that was not scored
  std::vector<LabelledText> extras;  // columns beyond those of a run: EGAD's score, baseline, ...
};

// InputError with file:line for a table that is cut short, lacks a column or holds no number where
// there must be one.
std::vector<ScoreRow> ReadScores(const std::filesystem::path& path);

}  // namespace antigrasp
