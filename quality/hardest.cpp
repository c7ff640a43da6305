#include "antigrasp/quality/hardest.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "antigrasp/core/statistics.h"
#include "antigrasp/quality/score_text.h"

namespace antigrasp {

HardestObjects FindHardest(std::vector<ScoreRow> rows, int count, const ScoresAgain& again) {
  HardestObjects found;
  found.of = std::ssize(rows);
  std::vector<HardestObject>& hardest = found.objects;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].score) {
      ++found.not_scored;
    } else if (rows[i].score->num_grasps == 0) {
      found.no_grasps.push_back(rows[i].object);
    } else {
      const double value = rows[i].score->graspability;
      hardest.push_back({static_cast<std::int64_t>(i), std::move(rows[i]), value});
    }
  }
  std::sort(hardest.begin(), hardest.end(), [](const HardestObject& a, const HardestObject& b) {
    return std::tie(a.chosen_by, a.row.object) < std::tie(b.chosen_by, b.row.object);
  });
  hardest.resize(std::min(hardest.size(), static_cast<std::size_t>(count)));
  std::vector<std::int64_t> places;
  for (const HardestObject& object : hardest) places.push_back(object.place);
  const std::vector<Graspability> scores = again(places);
  for (std::size_t i = 0; i < hardest.size(); ++i) {
    hardest[i].fresh = scores[i].value;
    auto& extras = hardest[i].row.extras;
    extras.emplace_back("graspability_fresh_draws", scores[i].value);
    extras.emplace_back("fresh_ci_low", scores[i].ci_low);
    extras.emplace_back("fresh_ci_high", scores[i].ci_high);
  }
  return found;
}

std::string HardestCsv(const HardestObjects& hardest) {
  ScoreTable table;
  for (const HardestObject& object : hardest.objects) table.Add(object.row);
  return table.Csv();
}

std::vector<std::string> HardestText(const HardestObjects& hardest, int more_grasps) {
  std::vector<double> chosen_by, fresh;
  for (const HardestObject& object : hardest.objects) {
    chosen_by.push_back(object.chosen_by);
    fresh.push_back(object.fresh);
  }
  std::string text = "the " + std::to_string(hardest.objects.size()) + " hardest of " +
                     std::to_string(hardest.of) + ": mean graspability " +
                     MeanText(MeanWithInterval(chosen_by), 5) + " by the scores that chose them, " +
                     MeanText(MeanWithInterval(fresh), 5) + " under fresh draws";
  if (more_grasps > 0) text += " of " + std::to_string(more_grasps) + " grasps";
  std::vector<std::string> lines = {text};
  if (!hardest.no_grasps.empty()) {
    lines.push_back("not among them, as they offer no grasp: " + FirstNames(hardest.no_grasps));
  }
  if (hardest.not_scored > 0) {
    lines.push_back("not among them, as they have no score: " + std::to_string(hardest.not_scored));
  }
  return lines;
}

}  // namespace antigrasp
