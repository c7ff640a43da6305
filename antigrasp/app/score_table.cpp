#include "antigrasp/app/score_table.h"

#include <cmath>
#include <limits>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

double NumberOrGap(const CsvReader& csv, std::size_t column) {
  if (csv.Field(column).empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto number = csv.Number(column);
  if (!number) {
    throw InputError(csv.names()[column] + " = \"" + csv.Field(column) + "\"", csv.Where(),
                     "a number");
  }
  return *number;
}

std::size_t RequireColumn(const CsvReader& csv, const std::filesystem::path& path,
                          const std::string& name) {
  const auto column = csv.Column(name);
  if (!column) throw InputError("no column " + name, path.string() + ":1", "column " + name);
  return *column;
}

std::vector<ScoreRow> ReadScores(const std::filesystem::path& path) {
  CsvReader csv(path);
  const auto column = [&](const char* name) { return RequireColumn(csv, path, name); };
  const std::size_t object = column("object"), status = column("status"),
                    grasps = column("num_grasps"), graspability = column("graspability"),
                    low = column("ci_low"), high = column("ci_high"), mean = column("mean"),
                    nonzero = column("fraction_nonzero");
  std::vector<ScoreRow> rows;
  while (csv.Next()) {
    ScoreRow row{csv.Field(object), csv.Field(status), {}, {}};
    const double value = NumberOrGap(csv, graspability);
    if (!std::isnan(value)) {
      const double count = NumberOrGap(csv, grasps);
      row.score = ReportScore{value,
                              NumberOrGap(csv, low),
                              NumberOrGap(csv, high),
                              NumberOrGap(csv, mean),
                              NumberOrGap(csv, nonzero),
                              count >= 0.0 && count < 1e9 ? static_cast<int>(count) : 0};
    }
    for (const auto& [name, label] :
         {LabelledText{"egad", "EGAD's score"}, LabelledText{"baseline", "baseline"},
          LabelledText{"difference", "difference to the baseline"}}) {
      const auto extra = csv.Column(name);
      if (extra && !csv.Field(*extra).empty()) row.extras.emplace_back(label, csv.Field(*extra));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace antigrasp
