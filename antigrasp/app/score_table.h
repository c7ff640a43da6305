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

// The field of the row as a number; NaN for an empty one. InputError for anything else.
class CsvReader;
double NumberOrGap(const CsvReader& csv, std::size_t column);

// The column of this name; InputError when the table has none.
std::size_t RequireColumn(const CsvReader& csv, const std::filesystem::path& path,
                          const std::string& name);

}  // namespace antigrasp
