#include "antigrasp/quality/score_table.h"

#include <cmath>

#include "antigrasp/core/csv_reader.h"

namespace antigrasp {

namespace {

std::vector<std::string> Columns(const ScoreRow& row) {
  std::vector<std::string> columns = {"object", "status",  "num_grasps", "graspability",
                                      "ci_low", "ci_high", "mean",       "fraction_nonzero"};
  for (const auto& [name, value] : row.extras) columns.push_back(name);
  for (const auto& [name, text] : row.texts) columns.push_back(name);
  return columns;
}

}  // namespace

std::optional<ScoreSummary> SummaryOf(const Graspability& score) {
  if (score.status == GraspabilityStatus::kNotEvaluable) return std::nullopt;
  return ScoreSummary{score.value, score.ci_low,           score.ci_high,
                      score.mean,  score.fraction_nonzero, static_cast<int>(score.grasps.size())};
}

void ScoreTable::Add(const ScoreRow& row) {
  if (!csv_) csv_.emplace(Columns(row));
  const double nan = std::nan("");
  const ScoreSummary s = row.score.value_or(ScoreSummary{nan, nan, nan, nan, nan, 0});
  csv_->Text(row.object).Text(row.status).Count(s.num_grasps);
  csv_->NumbersOrGaps({s.graspability, s.ci_low, s.ci_high, s.mean, s.fraction_nonzero});
  for (const auto& [name, value] : row.extras) csv_->NumberOrGap(value);
  for (const auto& [name, text] : row.texts) csv_->Text(text);
  csv_->EndRow();
}

std::string ScoreTable::Csv() const { return csv_ ? csv_->text() : CsvWriter(Columns({})).text(); }

std::string ScoresCsv(const std::vector<ScoreRow>& rows) {
  ScoreTable table;
  for (const ScoreRow& row : rows) table.Add(row);
  return table.Csv();
}

std::vector<ScoreRow> ReadScores(const std::filesystem::path& path) {
  CsvReader csv(path);
  const auto column = [&](const char* name) { return csv.RequiredColumn(name); };
  const std::size_t object = column("object"), status = column("status"),
                    grasps = column("num_grasps"), graspability = column("graspability"),
                    low = column("ci_low"), high = column("ci_high"), mean = column("mean"),
                    nonzero = column("fraction_nonzero");
  std::vector<ScoreRow> rows;
  while (csv.Next()) {
    ScoreRow row{csv.Field(object), csv.Field(status), {}};
    const double value = csv.NumberOrGap(graspability);
    if (!std::isnan(value)) {
      const double count = csv.NumberOrGap(grasps);
      row.score = ScoreSummary{value,
                               csv.NumberOrGap(low),
                               csv.NumberOrGap(high),
                               csv.NumberOrGap(mean),
                               csv.NumberOrGap(nonzero),
                               count >= 0.0 && count < 1e9 ? static_cast<int>(count) : 0};
    }
    for (const char* name : kScoreExtras) {
      const auto extra = csv.Column(name);
      if (extra) row.extras.emplace_back(name, csv.NumberOrGap(*extra));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace antigrasp
