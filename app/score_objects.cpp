#include "antigrasp/app/score_objects.h"

#include <spdlog/spdlog.h>

#include <optional>

#include "antigrasp/app/console.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {

ScoredObject ScoreObject(const InputObject& object, std::uint64_t stream, const Scoring& scoring) {
  ScoredObject scored =
      ScoreObject(object.name, object.status, object.mesh, stream, scoring.metric, scoring.seed);
  scored.note = object.note;
  return scored;
}

ScoredSet ScoreObjects(const ObjectSource& objects, const std::string& where,
                       const ObjectSource* originals, const std::vector<std::int64_t>& original_of,
                       const Scoring& scoring, const TakeScored& take) {
  using Pair = std::pair<ScoredObject, std::optional<ScoredObject>>;
  ScoredSet set(scoring.metric, scoring.egad);
  ConsoleObserver console;
  StreamInOrder(
      objects.size(), scoring.threads,
      [&](std::int64_t i) {
        const std::uint64_t stream = objects.stream(i);
        Pair pair;
        if (originals != nullptr) {
          const std::int64_t place = original_of[static_cast<std::size_t>(i)];
          pair.second = ScoreObject(originals->Load(place), stream, scoring);
        }
        pair.first = ScoreObject(objects.Load(i), stream, scoring);
        return pair;
      },
      [&](std::int64_t, const Pair& pair) {
        take(pair.first, set.Add(pair.first, pair.second ? &*pair.second : nullptr));
      },
      console.Phase("scoring"));
  const std::string shared = SharedDrawsText(objects.streams());
  if (!shared.empty()) set.AddNote(shared);
  for (const std::string& warning : set.Warnings()) spdlog::warn("{}", warning);
  set.RequireAScore(where);
  return set;
}

CLI::Option* AddHardestFlag(CLI::App* command, int* count, const std::string& help) {
  return command->add_option("--hardest", *count, help)
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
}

HardestOfSet FindHardest(const ObjectSource& objects, const std::string& where, int count,
                         const Scoring& scoring) {
  std::vector<ScoreRow> rows;
  const ScoredSet set =
      ScoreObjects(objects, where, nullptr, {}, scoring,
                   [&](const ScoredObject&, const ScoreRow& row) { rows.push_back(row); });
  for (const ScoreRow& row : rows) {
    if (!row.score) spdlog::warn("not scored: {}: {}", row.object, row.status);
  }
  Scoring fresh = scoring;
  fresh.seed = FreshSeed(scoring.seed);
  if (!scoring.effort_given) RaiseEffortForFew(1, &fresh.metric);
  ConsoleObserver console;
  HardestOfSet found{
      FindHardest(
          std::move(rows), count,
          [&](std::int64_t place) {
            return ScoreObject(objects.Load(place), objects.stream(place), fresh).score;
          },
          scoring.threads, console.Phase("scoring the hardest again")),
      set.Summary(scoring.effort_given)};
  if (found.objects.empty()) {
    throw InputError("no object has a grasp; " + FirstNames(found.no_grasps), where,
                     "objects that the gripper can hold");
  }
  const int grasps = fresh.metric.num_grasps;
  for (std::string& line : HardestText(found, grasps > scoring.metric.num_grasps ? grasps : 0)) {
    found.summary.push_back(std::move(line));
  }
  return found;
}

}  // namespace antigrasp
