// Judges by name, and what is said of their verdicts.
#include "antigrasp/judge/make_judge.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/trial/trial_summary.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

JudgeOptions FewGrasps() {
  JudgeOptions options;
  options.metric.num_grasps = 6;
  options.metric.num_draws = 2;
  options.metric.friction = 0.3;
  options.trial.draws = 2;
  options.seed = 7;
  return options;
}

// As if one option had been typed.
TypedTrial Typed(const std::string& key, const std::string& value) {
  return {[=](OptionTable* table) { table->ApplyValue(key, value, "typed"); },
          [=](const std::string& other) { return other == key ? key + " " + value : ""; }};
}

std::string WhyNot(const std::string& name, const JudgeOptions& options = {}) {
  try {
    MakeJudge(name, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MakeJudge, EpsilonIsTheGraspabilityOfTheObjectsOwnDraws) {
  const JudgeOptions options = FewGrasps();
  const auto judge = MakeJudge("epsilon", options);
  const TriangleMesh box = shapes::Box({1.0, 1.5, 2.0}), empty;
  const std::vector<Verdict> verdicts =
      judge->Score({{"box", &box, 3}, {"box", &box, 4}, {"empty", &empty, 3}});
  for (const std::uint64_t stream : {3, 4}) {
    EXPECT_EQ(verdicts[stream - 3].score,
              EvaluateGraspability(box, options.metric, 7, stream).value);
  }
  EXPECT_NE(verdicts[0].score, verdicts[1].score);
  EXPECT_EQ(verdicts[2].status, "not_evaluable");
  EXPECT_EQ(judge->Name(), "epsilon");
}

#ifdef ANTIGRASP_HAS_MUJOCO
TEST(MakeJudge, TrialIsTheShareHeldAtEqualMass) {
  JudgeOptions options = FewGrasps();
  const TriangleMesh box = shapes::Box({1.0, 1.5, 2.0});
  const TriangleMesh wide = shapes::Box({3.0, 3.0, 3.0});  // 40 mm is less than the jaws open
  const auto judge = MakeJudge("trial", options);
  EXPECT_EQ(judge->Name(), "trial:six-ways");
  EXPECT_EQ(options.trial.mass, 0.05);
  PhysicsTrials trials(options.metric, options.trial, 7);
  const Verdict verdict = judge->Score({{"box", &box, 3}}).front();
  const PhysicsTrial trial = trials.Try(box, 3);
  EXPECT_EQ(trial.mass, 0.05);
  EXPECT_EQ(verdict.score, SummaryOf("box", trial, trials.protocol()).held.front().value);
  options.metric.jaw_opening = 0.03;
  const Verdict none = MakeJudge("trial", options)->Score({{"wide", &wide, 3}}).front();
  EXPECT_FALSE(none.score);
  EXPECT_EQ(none.status, "no reachable grasp");
}

TEST(MakeJudge, WhatWasTypedGoesBeforeTheProtocolAndIsRecorded) {
  JudgeOptions options = FewGrasps();
  options.metric.friction_std = 0.0;
  options.typed = Typed("trial.mass", "0.3");
  const auto heavy = MakeJudge("trial:dexgraspbench", options);
  std::string toml = heavy->Toml();
  EXPECT_NE(toml.find("\n[judge]\nname = 'trial:dexgraspbench'"), std::string::npos) << toml;
  EXPECT_NE(toml.find("\n[judge.trial]\n"), std::string::npos) << toml;
  EXPECT_NE(toml.find("\nmass = 0.3"), std::string::npos) << toml;
  EXPECT_NE(toml.find("\nfriction = 0.6"), std::string::npos) << toml;  // the protocol's
  options.typed.friction = true;
  options.metric.friction = 0.02;  // lets go of what is held at 0.6
  const TriangleMesh cube = shapes::Cube();
  EXPECT_LT(MakeJudge("trial:dexgraspbench", options)->Score({{"cube", &cube, 3}})[0].score, 0.5);
  EXPECT_NE(MakeJudge("trial", FewGrasps())->Toml().find("\nmass = 0.05"), std::string::npos);
}

TEST(MakeJudge, OptionsOfATrialAreRefusedWhereTheyAreOfNoUse) {
  const auto why = [](const std::string& name, const std::string& key, const std::string& value) {
    JudgeOptions options;
    options.typed = Typed(key, value);
    return WhyNot(name, options);
  };
  EXPECT_EQ(why("settled", "trial.mass", "0.1"),
            "judge settled has no such thing (trial.mass 0.1): expected --judge trial or "
            "trial:PROTOCOL");
  EXPECT_EQ(why("trial:paper", "trial.draws", "3"),
            "protocol paper has no such thing (trial.draws 3): expected --executions");
  EXPECT_EQ(why("trial", "trial.pad_width", "0.01"),
            "a ball has no such thing (trial.pad_width 0.01): expected --tip pad");
  EXPECT_EQ(why("trial", "trial.draws", "3"), "");
}

TEST(MakeJudge, AProtocolBringsItsOwnMassAndFriction) {
  // Held by friction 1 in the air, dropped by friction 0.02 on the table.
  JudgeOptions options = FewGrasps();
  options.metric.friction = 0.02;
  options.metric.friction_std = 0.0;
  options.trial.mass = 0.2;
  const TriangleMesh cube = shapes::Cube();
  const std::vector<JudgedObject> shown = {{"cube", &cube, 3}};
  EXPECT_EQ(MakeJudge("trial:dexgraspbench", options)->Name(), "trial:dexgraspbench");
  EXPECT_GT(MakeJudge("trial:dexgraspbench", options)->Score(shown).front().score, 0.5);
  EXPECT_LT(MakeJudge("trial:six-ways", options)->Score(shown).front().score, 0.5);
}
#endif

TEST(MakeJudge, EveryJudgeSaysWhatItWasSetTo) {
  JudgeOptions options = FewGrasps();
  options.program = {7.5, 2};
  EXPECT_NE(MakeJudge("settled", options)->Toml().find("\nclosing = 'settled'"), std::string::npos)
      << MakeJudge("settled", options)->Toml();
  std::string name, limit;
  ProgramLimits limits;
  OptionTable table;
  table.Add("judge.name", &name, {}, "");
  table.Add("judge.limit", &limits.seconds, 0.0, 1e6, "");
  table.Add("judge.restarts", &limits.restarts, 0, 100, "");
  table.ApplyText(MakeJudge("./judge \"a b\" 'c'", options)->Toml(), "toml");
  EXPECT_EQ(name, "./judge \"a b\" 'c'");
  EXPECT_EQ(limits.seconds, 7.5);
  EXPECT_EQ(limits.restarts, 2);
}

TEST(MakeJudge, AProtocolThatDoesNotExistIsRefused) {
  EXPECT_EQ(WhyNot("trial:shake"),
            "no protocol shake (judge trial:shake): expected six-ways, paper, graspdatagen or "
            "dexgraspbench");
  EXPECT_EQ(MakeJudge("./trial", {})->Name(), "./trial");  // a program, not yet started
}

TEST(VerdictCount, NamesWhatHasNoScoreInTheOrderInWhichItCameUp) {
  VerdictCount count;
  EXPECT_EQ(count.Text(), "0 scored");
  for (const Verdict& verdict : {Verdict::Of(0.5), Verdict::None("late"), Verdict::Of(1.0 / 0.0),
                                 Verdict::Of(-2.0), Verdict::None("late")}) {
    count.Add(verdict);
  }
  EXPECT_EQ(count.Text(), "2 scored, 2 late, 1 not a finite number");
  EXPECT_EQ(count.scored(), 2);
}

}  // namespace
}  // namespace antigrasp
