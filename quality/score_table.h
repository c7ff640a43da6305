#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {

// The numbers of an evaluated object in scores.csv (docs/formats.md).
struct ScoreSummary {
  double graspability = 0.0, ci_low = 0.0, ci_high = 0.0, mean = 0.0, fraction_nonzero = 0.0;
  int num_grasps = 0;
};

// nullopt when the object is not evaluable.
std::optional<ScoreSummary> SummaryOf(const Graspability& score);

// What `evaluate` adds and is read again, in this order; older tables have the first four at most.
// Percentiles among known sets (ScoredSet) stand behind the extents and are not read: they follow
// from the score.
inline constexpr std::array kScoreExtras = {"seconds",
                                            "egad",
                                            "baseline",
                                            "difference",
                                            "metres_per_unit",
                                            "extent_x",
                                            "extent_y",
                                            "extent_z",
                                            "graspability_fresh_draws",
                                            "fresh_ci_low",
                                            "fresh_ci_high",
                                            "judge"};

// A row of scores.csv, of `evaluate` or of a run's stage.
struct ScoreRow {
  std::string object, status;
  std::optional<ScoreSummary> score;  // none for an object that was not scored
  // Columns beyond those of a run (kScoreExtras), the same ones in every row of a table; NaN is
  // a gap.
  std::vector<std::pair<std::string, double>> extras = {};
  std::vector<std::pair<std::string, std::string>> texts = {};  // behind them; not read
};

// scores.csv row by row, for sets of any size.
class ScoreTable {
 public:
  void Add(const ScoreRow& row);
  std::string Csv() const;

 private:
  std::optional<CsvWriter> csv_;  // with the columns of the first row
};
std::string ScoresCsv(const std::vector<ScoreRow>& rows);

// InputError with file:line for a table that is cut short, lacks a column or holds no number where
// there must be one. Extra columns are read where they are there.
std::vector<ScoreRow> ReadScores(const std::filesystem::path& path);

}  // namespace antigrasp
