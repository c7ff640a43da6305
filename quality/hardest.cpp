#include "antigrasp/quality/hardest.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "antigrasp/core/statistics.h"

namespace antigrasp {

std::vector<HardestObject> FindHardest(std::vector<ScoreRow> rows, int count,
                                       const ScoreAgain& again, int threads,
                                       const ProgressFn& progress) {
  std::vector<HardestObject> hardest;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].score) continue;
    const double value = rows[i].score->graspability;
    hardest.push_back({static_cast<std::int64_t>(i), std::move(rows[i]), value});
  }
  std::sort(hardest.begin(), hardest.end(), [](const HardestObject& a, const HardestObject& b) {
    return std::tie(a.chosen_by, a.row.object) < std::tie(b.chosen_by, b.row.object);
  });
  hardest.resize(std::min(hardest.size(), static_cast<std::size_t>(count)));
  ParallelFor(
      std::ssize(hardest), threads,
      [&](std::int64_t i) {
        HardestObject& found = hardest[static_cast<std::size_t>(i)];
        const Graspability fresh = again(found.place);
        found.fresh = fresh.value;
        found.row.extras.emplace_back("graspability_fresh_draws", fresh.value);
        found.row.extras.emplace_back("fresh_ci_low", fresh.ci_low);
        found.row.extras.emplace_back("fresh_ci_high", fresh.ci_high);
      },
      progress);
  return hardest;
}

std::string HardestCsv(const std::vector<HardestObject>& hardest) {
  ScoreTable table;
  for (const HardestObject& found : hardest) table.Add(found.row);
  return table.Csv();
}

std::string HardestText(const std::vector<HardestObject>& hardest, std::int64_t of) {
  std::vector<double> chosen_by, fresh;
  for (const HardestObject& found : hardest) {
    chosen_by.push_back(found.chosen_by);
    fresh.push_back(found.fresh);
  }
  return "the " + std::to_string(hardest.size()) + " hardest of " + std::to_string(of) +
         ": mean graspability " + MeanText(MeanWithInterval(chosen_by), 5) +
         " by the scores that chose them, " + MeanText(MeanWithInterval(fresh), 5) +
         " under fresh draws";
}

}  // namespace antigrasp
