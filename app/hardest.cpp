#include "antigrasp/app/hardest.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/statistics.h"

namespace antigrasp {

CLI::Option* AddHardestFlag(CLI::App* command, int* count, const std::string& help) {
  return command->add_option("--hardest", *count, help)
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
}

std::vector<ScoreRow> ScoreRowsOf(const ObjectSource& objects, const MetricOptions& metric,
                                  std::uint64_t seed, int threads, RunObserver* observer) {
  std::vector<ScoreRow> rows(static_cast<std::size_t>(objects.size()));
  ParallelFor(
      objects.size(), threads,
      [&](std::int64_t i) {
        const ScoredObject scored = ScoreObject(objects.Load(i), objects.stream(i), metric, seed);
        rows[static_cast<std::size_t>(i)] = RowOf(scored, false, nullptr);
      },
      observer->Phase("scoring"));
  return rows;
}

std::vector<HardestObject> FindHardest(const ObjectSource& objects, std::vector<ScoreRow> rows,
                                       int count, const MetricOptions& metric, std::uint64_t seed,
                                       int threads, RunObserver* observer) {
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
  const std::uint64_t fresh_seed = FreshSeed(seed);
  ParallelFor(
      std::ssize(hardest), threads,
      [&](std::int64_t i) {
        HardestObject& found = hardest[static_cast<std::size_t>(i)];
        const Graspability again =
            ScoreObject(objects.Load(found.place), objects.stream(found.place), metric, fresh_seed)
                .score;
        found.fresh = again.value;
        found.row.extras.emplace_back("graspability_fresh_draws", again.value);
        found.row.extras.emplace_back("fresh_ci_low", again.ci_low);
        found.row.extras.emplace_back("fresh_ci_high", again.ci_high);
      },
      observer->Phase("scoring the hardest again"));
  return hardest;
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
