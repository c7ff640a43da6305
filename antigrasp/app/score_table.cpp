#include "antigrasp/app/score_table.h"

#include <cmath>

#include "antigrasp/core/csv_reader.h"

namespace antigrasp {

std::vector<ScoreRow> ReadScores(const std::filesystem::path& path) {
  CsvReader csv(path);
  const auto column = [&](const char* name) { return csv.RequiredColumn(name); };
  const std::size_t object = column("object"), status = column("status"),
                    grasps = column("num_grasps"), graspability = column("graspability"),
                    low = column("ci_low"), high = column("ci_high"), mean = column("mean"),
                    nonzero = column("fraction_nonzero");
  std::vector<ScoreRow> rows;
  while (csv.Next()) {
    ScoreRow row{csv.Field(object), csv.Field(status), {}, {}};
    const double value = csv.NumberOrGap(graspability);
    if (!std::isnan(value)) {
      const double count = csv.NumberOrGap(grasps);
      row.score = ReportScore{value,
                              csv.NumberOrGap(low),
                              csv.NumberOrGap(high),
                              csv.NumberOrGap(mean),
                              csv.NumberOrGap(nonzero),
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
