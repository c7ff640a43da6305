// Which objects of a set count as its hardest, and what is said of a set that was scored.
#include "antigrasp/quality/hardest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/quality/sampling_effort.h"
#include "antigrasp/quality/scored_set.h"

namespace antigrasp {
namespace {

using Sentences = std::vector<std::string>;

ScoreRow HardestRow(const std::string& name, double graspability, int grasps) {
  ScoreRow row{name, grasps == 0 ? "no_grasps" : "ok", ScoreSummary{}};
  row.score->graspability = graspability;
  row.score->num_grasps = grasps;
  return row;
}

// "c" without a grasp is lower than all, "d" has no score.
std::vector<ScoreRow> HardestRows() {
  return {HardestRow("a", 0.003, 9),   HardestRow("b", 0.001, 9), HardestRow("c", 0.0, 0),
          {"d", "open", std::nullopt}, HardestRow("e", 0.001, 9), HardestRow("f", 0.0, 9)};
}

// The place of the object is its second score.
HardestObjects Hardest(std::vector<ScoreRow> rows, int count) {
  return FindHardest(std::move(rows), count, [](const std::vector<std::int64_t>& places) {
    std::vector<Graspability> scores(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      scores[k].value = static_cast<double>(places[k]);
    }
    return scores;
  });
}

TEST(FindHardest, TakesTheLowestOfThoseThatHaveAGraspAndNamesTheOthersApart) {
  const HardestObjects found = Hardest(HardestRows(), 3);
  ASSERT_EQ(found.objects.size(), 3u);
  EXPECT_EQ(found.objects[0].row.object, "f");  // grasps that hold nothing are grasps
  EXPECT_EQ(found.objects[1].row.object, "b");  // of equal ones by name
  EXPECT_EQ(found.objects[2].row.object, "e");
  EXPECT_EQ(found.objects[1].chosen_by, 0.001);
  EXPECT_EQ(found.objects[1].fresh, 1.0);
  EXPECT_EQ(found.objects[2].place, 4);
  EXPECT_EQ(found.no_grasps, Sentences{"c"});
  EXPECT_EQ(found.not_scored, 1);
  EXPECT_EQ(found.of, 6);
  EXPECT_EQ(Hardest(HardestRows(), 9).objects.size(), 4u);
  EXPECT_TRUE(Hardest({HardestRow("c", 0.0, 0)}, 1).objects.empty());
}

TEST(FindHardest, SaysHowManyGraspsTheSecondScoresTookAndWhoIsLeftOut) {
  EXPECT_EQ(
      HardestText(Hardest(HardestRows(), 1), 1000),
      (Sentences{"the 1 hardest of 6: mean graspability 0.00000 by the scores that chose them, "
                 "5.00000 under fresh draws of 1000 grasps",
                 "not among them, as they offer no grasp: 1: c",
                 "not among them, as they have no score: 1"}));
  EXPECT_EQ(
      HardestText(Hardest({HardestRow("a", 0.25, 9)}, 1), 0),
      Sentences{"the 1 hardest of 1: mean graspability 0.25000 by the scores that chose them, "
                "0.00000 under fresh draws"});
}

ScoredObject Scored(const std::string& name, GraspabilityStatus status, double value) {
  ScoredObject scored{name, std::string(Name(status)), "", {1, 1, 1}, {1, 1, 1}, {}};
  scored.score.status = status;
  scored.score.value = value;
  if (status == GraspabilityStatus::kOk) scored.score.grasps = {{{}, value, 1}, {{}, value, 1}};
  return scored;
}

TEST(ScoredSet, AnObjectWithoutAGraspIsNamedAndStandsBesideNoKnownSet) {
  ScoredSet one{MetricOptions()};
  one.Add(Scored("wide", GraspabilityStatus::kNoGrasps, 0.0));
  const Sentences lines = one.Summary(true);
  EXPECT_EQ(lines.back(), "no grasp, graspability 0 (status no_grasps): 1: wide");

  // The others are, by their own mean: easier than everything that is known.
  ScoredSet set{MetricOptions()};
  for (const char* name : {"w", "x", "y", "z"}) {
    set.Add(Scored(name, GraspabilityStatus::kNoGrasps, 0.0));
  }
  set.Add(Scored("easy", GraspabilityStatus::kOk, 1.0));
  const Sentences all = set.Summary(true);
  EXPECT_EQ(all[0],
            "5 objects scored, 0 not: mean graspability 0.20000 +-0.39200 (95 %), each scaled to "
            "a smallest extent of 40 mm");
  EXPECT_EQ(all[all.size() - 2],
            "no grasp, graspability 0 (status no_grasps): 4: w, x, y and 1 more");
  EXPECT_EQ(all.back().substr(0, 36), "harder to grasp than 0 % of cylinder");
  EXPECT_NE(all.back().find("; of those with a grasp"), std::string::npos) << all.back();
}

TEST(ScoredSet, ARowSaysOfHowManyPercentOfEveryKnownSetItIsHarder) {
  ScoredSet set{MetricOptions()};
  const KnownSet* known = KnownSetsAt(MetricOptions()).front();
  const auto cell = [](const ScoreRow& row) {
    for (const auto& [name, value] : row.extras) {
      if (name == "harder_than_cylinders_pct") return value;
    }
    return -1.0;
  };
  ASSERT_EQ(known->name, "cylinders");
  const double lowest = known->scores.front(), highest = known->scores.back();
  EXPECT_EQ(cell(set.Add(Scored("a", GraspabilityStatus::kOk, 0.5 * lowest))), 100.0);
  EXPECT_EQ(cell(set.Add(Scored("b", GraspabilityStatus::kOk, 2.0 * highest))), 0.0);
  EXPECT_TRUE(std::isnan(cell(set.Add(Scored("c", GraspabilityStatus::kNoGrasps, 0.0)))));
  MetricOptions other;
  other.friction = 0.4;
  ScoredSet unknown{other};
  EXPECT_EQ(cell(unknown.Add(Scored("a", GraspabilityStatus::kOk, 0.5))), -1.0);
}

TEST(ScoredSet, WithoutAnyScoreIsRefusedByItsFirstStatus) {
  ScoredSet set{MetricOptions()};
  set.Add(Scored("flat", GraspabilityStatus::kNotEvaluable, 0.0));
  try {
    set.RequireAScore("in");
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "no object scored; flat: not_evaluable (in): expected a closed solid");
  }
}

TEST(EffortRule, HasTheNumbersOfTheRule) {
  EXPECT_NE(EffortRule().find(std::to_string(kGraspsOfFew) + " grasps"), std::string::npos);
  EXPECT_NE(EffortRule().find("at most " + std::to_string(kFewObjects)), std::string::npos);
}

}  // namespace
}  // namespace antigrasp
