#include "antigrasp/perturb/perturb_table.h"

#include <algorithm>
#include <cstdint>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

void AppendCount(double count, CsvWriter* csv) {
  csv->CountOrGap(std::isnan(count) ? -1 : static_cast<std::int64_t>(count));
}

}  // namespace

std::string PerturbCsv(const std::vector<PerturbRow>& rows) {
  std::vector<std::string> names = {"object", "status"};
  for (const PerturbColumn& column : kPerturbColumns) names.push_back(column.name);
  const bool judged = std::any_of(rows.begin(), rows.end(),
                                  [](const PerturbRow& row) { return !row.judge.empty(); });
  if (judged) names.insert(names.end(), {"judge", "judge_before", "judge_after"});
  CsvWriter csv(names);
  for (const PerturbRow& row : rows) {
    csv.Text(row.object).Text(row.status);
    for (const PerturbColumn& column : kPerturbColumns) {
      if (column.count) {
        AppendCount(row.*column.value, &csv);
      } else {
        csv.NumberOrGap(row.*column.value);
      }
    }
    if (judged) csv.Text(row.judge).NumbersOrGaps({row.judge_before, row.judge_after});
    csv.EndRow();
  }
  return csv.text();
}

std::vector<PerturbRow> ReadPerturbTable(const std::filesystem::path& path) {
  CsvReader csv(path);
  const std::size_t object = csv.RequiredColumn("object"), status = csv.RequiredColumn("status");
  csv.RequiredColumn("graspability_before");
  csv.RequiredColumn("graspability_after");
  std::vector<PerturbRow> rows;
  while (csv.Next()) {
    PerturbRow row{csv.Field(object), csv.Field(status)};
    for (const PerturbColumn& column : kPerturbColumns) {
      const auto at = csv.Column(column.name);
      if (at) row.*column.value = csv.NumberOrGap(*at);
    }
    if (const auto judge = csv.Column("judge")) row.judge = csv.Field(*judge);
    if (const auto before = csv.Column("judge_before")) row.judge_before = csv.NumberOrGap(*before);
    if (const auto after = csv.Column("judge_after")) row.judge_after = csv.NumberOrGap(*after);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string PerturbHistoryCsv(const std::vector<PerturbHistory>& histories) {
  CsvWriter csv({"object", "iteration", "pairs", "pairs_below_cone"});
  for (const PerturbHistory& history : histories) {
    for (std::size_t i = 0; i < history.iteration.size(); ++i) {
      csv.Text(history.object);
      AppendCount(history.iteration[i], &csv);
      AppendCount(history.pairs[i], &csv);
      AppendCount(history.pairs_below_cone[i], &csv);
      csv.EndRow();
    }
  }
  return csv.text();
}

std::vector<PerturbHistory> ReadPerturbHistory(const std::filesystem::path& path) {
  RequireFile(path, "history.csv of antigrasp perturb ... --history");
  CsvReader csv(path);
  const std::size_t object = csv.RequiredColumn("object");
  const std::size_t iteration = csv.RequiredColumn("iteration");
  const std::size_t pairs = csv.RequiredColumn("pairs");
  const auto below = csv.Column("pairs_below_cone");
  std::vector<PerturbHistory> histories;
  while (csv.Next()) {
    if (histories.empty() || histories.back().object != csv.Field(object)) {
      histories.push_back({csv.Field(object), {}, {}, {}});
    }
    const auto number = [&](std::size_t column) {
      return csv.Number(column).value_or(std::nan(""));
    };
    histories.back().iteration.push_back(number(iteration));
    histories.back().pairs.push_back(number(pairs));
    histories.back().pairs_below_cone.push_back(below ? number(*below) : std::nan(""));
  }
  if (histories.empty()) throw InputError("no rows", path.string(), "a history of an object");
  return histories;
}

}  // namespace antigrasp
