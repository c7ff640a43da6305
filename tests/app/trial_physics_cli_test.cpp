// `antigrasp trial` in physics, as a user meets it: tables, refusals, folders, baselines.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using cli::Antigrasp;
using cli::ExpectRefused;
using Rows = std::vector<std::map<std::string, std::string>>;

Rows Table(const std::filesystem::path& file) {
  std::istringstream lines(ReadFile(file));
  std::string line, field;
  std::vector<std::string> names;
  std::getline(lines, line);
  for (std::istringstream header(line); std::getline(header, field, ',');) names.push_back(field);
  Rows rows;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (const std::string& name : names) {
      field.clear();
      std::getline(fields, field, ',');
      rows.back()[name] = field;
    }
  }
  return rows;
}

double Number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

// Millimetres: a cube and a sphere that the gripper holds, a box that it cannot open to, one with
// a hole.
class TrialPhysicsCli : public testing::Test {
 protected:
  TrialPhysicsCli() {
    TriangleMesh open = shapes::Box({30.0, 30.0, 30.0});
    open.faces.pop_back();
    for (const char* set : {"after", "before"}) {
      std::filesystem::create_directories(folder_ / set);
      WriteMesh(folder_ / set / "cube.stl", shapes::Box({30.0, 30.0, 30.0}));
    }
    WriteMesh(folder_ / "sphere.stl", shapes::Sphere(15.0, 3));
    WriteMesh(folder_ / "wide.stl", shapes::Box({90.0, 90.0, 90.0}));
    WriteMesh(folder_ / "open.stl", open);
    WriteMesh(folder_ / "after" / "other.stl", shapes::Box({30.0, 30.0, 60.0}));
    WriteMesh(folder_ / "before" / "other.stl", open);
  }
  std::string File(const std::string& name) const { return (folder_ / name).string(); }
  std::string Trial(const std::string& object) const {
    return "trial " + File(object) + " --mm --num-grasps 6 --draws 2 --num-draws 2 ";
  }
  cli::Outcome Run(const std::string& arguments) const {
    const cli::Outcome outcome = Antigrasp(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.text;
    return outcome;
  }
  shapes::TempFolder folder_;
};

TEST_F(TrialPhysicsCli, EveryExecutionIsARowAndOneOutcome) {
  Run(Trial("after/cube.stl") + "--out " + File("t"));
  const Rows trials = Table(folder_ / "t" / "trials.csv");
  const Rows executions = Table(folder_ / "t" / "executions.csv");
  ASSERT_EQ(trials.size(), 1u);
  auto row = trials[0];
  EXPECT_EQ(row["object"], "cube.stl");
  EXPECT_EQ(row["status"], "ok");
  EXPECT_EQ(row["side"], "after");
  EXPECT_NEAR(Number(row["mass"]), 0.027, 1e-12);  // 30 mm cubed of 1000 kg/m3
  EXPECT_EQ(row["poses"], "6");
  EXPECT_EQ(row["grasps"], "6");
  EXPECT_EQ(row["executions"], "12");
  EXPECT_EQ(executions.size(), 12u);
  std::map<std::string, int> outcomes;
  int deep = 0;
  for (auto execution : executions) {
    ++outcomes[execution["outcome"]];
    deep += Number(execution["penetration_mm"]) > 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(Number(row["held"]), outcomes["held"] / 12.0, 1e-12);
  int sum = outcomes["held"];
  for (const auto& [column, outcome] :
       std::map<std::string, std::string>{{"slipped", "slipped"},
                                          {"turned_away", "turned away"},
                                          {"lost_closing", "lost closing"},
                                          {"never_touched", "never touched"},
                                          {"started_in_collision", "started in collision"},
                                          {"unstable", "unstable"}}) {
    EXPECT_EQ(Number(row[column]), outcomes[outcome]) << column;
    sum += outcomes[outcome];
  }
  EXPECT_EQ(sum, 12);
  EXPECT_EQ(Number(row["untrusted"]), deep);
}

TEST_F(TrialPhysicsCli, CubeAndSphereAreHeldWithoutNoiseAndNothingWithoutFriction) {
  const std::string both = Trial("after/cube.stl") + File("sphere.stl") + " --noise none --out ";
  Run(both + File("held"));
  for (auto row : Table(folder_ / "held" / "trials.csv")) EXPECT_EQ(row["held"], "1");
  Run(both + File("lost") + " --friction 0");
  for (auto row : Table(folder_ / "lost" / "trials.csv")) EXPECT_EQ(row["held"], "0");
}

TEST_F(TrialPhysicsCli, EveryFileHasTheSameBytesForAnyNumberOfThreads) {
  const std::string command = Trial("after") + "--baseline " + File("before") + " --out ";
  Run(command + File("one") + " --threads 1");
  Run(command + File("three") + " --threads 3");
  const auto one = shapes::FileContents(folder_ / "one");
  EXPECT_EQ(one.size(), 5u);
  EXPECT_TRUE(one == shapes::FileContents(folder_ / "three"));
}

// The original of `other` has a hole: it pairs in nothing, the share of candidates included.
TEST_F(TrialPhysicsCli, ABaselinePairsWhatBothSidesHave) {
  const std::string text =
      Run(Trial("after") + "--baseline " + File("before") + " --out " + File("t")).text;
  EXPECT_NE(text.find("(1 pairs; not paired: 1 before: open)"), std::string::npos) << text;
  const Rows trials = Table(folder_ / "t" / "trials.csv");
  EXPECT_EQ(trials.size(), 8u);  // two objects, two sides, own and equal mass
  for (auto row : trials) {
    if (row["masses"] == "equal" && row["status"] == "ok") {
      EXPECT_EQ(row["mass"], "0.05");
    }
  }
  for (auto row : Table(folder_ / "t" / "means.csv")) {
    EXPECT_EQ(row["objects"], "2") << row["grasps"];
    EXPECT_EQ(row["pairs"], "1") << row["grasps"];
    EXPECT_EQ(Number(row["difference"]), 0.0) << row["grasps"];  // the same cube on both sides
  }
  ExpectRefused(Trial("sphere.stl") + "--baseline " + File("before"),
                "expected exactly one object");
}

TEST_F(TrialPhysicsCli, AnObjectThatCannotBeTriedIsCountedBesideOthers) {
  const std::string text =
      Run(Trial("after/cube.stl") + File("wide.stl") + " " + File("open.stl")).text;
  // Without a reachable grasp as little is known of it as with a hole.
  EXPECT_NE(text.find("(mean over 1 of 3 objects; not in it: 1 no reachable grasp, 1 open)"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("no reachable grasp"), std::string::npos) << text;
  EXPECT_NE(text.find("open: 3 boundary edges"), std::string::npos) << text;
  const cli::Outcome alone = Antigrasp(Trial("wide.stl") + "--out " + File("none"));
  EXPECT_EQ(alone.code, 2) << alone.text;
  EXPECT_NE(alone.text.find("wide.stl: no reachable grasp"), std::string::npos) << alone.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
}

TEST_F(TrialPhysicsCli, CtrlCKeepsWhatWasTriedAndTheSameCallGoesOn) {
  std::string many = "trial";
  for (int i = 0; i < 12; ++i) {
    const std::string name = std::to_string(100 + i) + ".stl";
    WriteMesh(folder_ / name, shapes::Box({30.0 + 0.1 * i, 32.0, 50.0}));
    many += " " + File(name);
  }
  many += " --mm --num-grasps 20 --draws 2 --threads 1 --out ";
  cli::Outcome outcome;
  // Until it came as far as the work, a twelfth of which is enough.
  for (const char* seconds : {"0.2", "0.4", "0.8", "1.6", "3.2", "6.4", "12.8", "25.6"}) {
    outcome = cli::Shell(std::string("timeout -s INT ") + seconds + " " ANTIGRASP_BINARY " " +
                         many + File("t"));
    if (std::filesystem::exists(folder_ / "t" / "trials.csv")) break;
  }
  EXPECT_NE(outcome.text.find("antigrasp: interrupted\n"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find(" of 12 trials of an object; the same call"), std::string::npos)
      << outcome.text;
  const std::size_t rows = Table(folder_ / "t" / "trials.csv").size();
  EXPECT_GT(rows, 0u);
  EXPECT_LT(rows, 12u);
  Run(many + File("t"));
  Run(many + File("whole"));
  EXPECT_TRUE(shapes::FileContents(folder_ / "t") == shapes::FileContents(folder_ / "whole"));
}

TEST_F(TrialPhysicsCli, InfoSaysWhatItsFolderAndOneOfPairsHold) {
  Run(Trial("after/cube.stl") + "--out " + File("t"));
  const std::string text = Run("info " + File("t")).text;
  EXPECT_NE(text.find(": trials, six-ways, fingertip sphere of 5 mm, mujoco "), std::string::npos)
      << text;
  EXPECT_EQ(Run("info --csv " + File("t")).text, ReadFile(folder_ / "t" / "means.csv"));
  Run("dataset pair " + File("before/cube.stl") + " " + File("after/cube.stl") +
      " --units mm --true-size --num-grasps 4 --draws 1 --out " + File("pairs"));
  EXPECT_NE(Run("info " + File("pairs")).text.find(": pairs of objects, 1 (1 train)\n"),
            std::string::npos);
  ExpectRefused("info --csv " + File("pairs"), "no table of");
}

TEST_F(TrialPhysicsCli, TheSettledMetricsColumnIsNotCalledForceClosure) {
  const std::string cube = Trial("after/cube.stl");
  EXPECT_NE(Run(cube).text.find("   top  force closure\n"), std::string::npos);
  EXPECT_NE(Run(cube + "--preset settled").text.find("   top  settled holds\n"), std::string::npos);
}

// A judge is a trial: the same options, the same numbers.
TEST_F(TrialPhysicsCli, ATrialAsJudgeTakesItsOptionsAndSaysThem) {
  const std::string options = " --num-grasps 6 --draws 2 --num-draws 2 --mass 0.3 --friction 0.3 ";
  Run("trial " + File("after/cube.stl") + " --mm" + options + "--out " + File("t"));
  Run("evaluate " + File("after/cube.stl") + " --units mm --true-size --judge trial" + options +
      "--out " + File("s.csv"));
  EXPECT_EQ(Table(folder_ / "s.csv")[0]["judge"], Table(folder_ / "t" / "trials.csv")[0]["held"]);
  const std::string toml = ReadFile(folder_ / "s.csv.metric.toml");
  EXPECT_NE(toml.find("\n[judge]\nname = 'trial:six-ways'"), std::string::npos) << toml;
  EXPECT_NE(toml.find("\nmass = 0.3"), std::string::npos) << toml;
  const std::string judge = "evaluate " + File("after/cube.stl") + " --judge ";
  ExpectRefused(judge + "settled --mass 0.3", "judge settled has no such thing (--mass 0.3)");
  ExpectRefused(judge + "trial:paper --draws 2", "protocol paper has no such thing (--draws 2)");
  const cli::Outcome none = Antigrasp("evaluate " + File("wide.stl") +
                                      " --units mm --true-size --num-grasps 5 --judge trial");
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_NE(none.text.find("the judge scored no object: 0 scored, 1 no reachable grasp"),
            std::string::npos)
      << none.text;
}

TEST_F(TrialPhysicsCli, AUsedFolderStaysAsItIsUnlessItMayBeOverwritten) {
  const std::string command = Trial("after/cube.stl") + "--out " + File("t");
  Run(command);
  folder_.Write("t/notes.txt", "mine");
  const auto before = shapes::FileContents(folder_ / "t");
  ExpectRefused(command + " --seed 2", "holds trials.csv already");
  EXPECT_TRUE(before == shapes::FileContents(folder_ / "t"));
  Run(command + " --seed 2 --overwrite");
  auto after = shapes::FileContents(folder_ / "t");
  EXPECT_EQ(after.size(), before.size());
  EXPECT_EQ(after["notes.txt"], "mine");
  EXPECT_NE(after["executions.csv"], before.at("executions.csv"));
  folder_.Write("file", "");
  ExpectRefused(Trial("after/cube.stl") + "--out " + File("file"), "expected a folder");
}

TEST_F(TrialPhysicsCli, WhatCannotBeIsRefusedInOneLine) {
  const std::string cube = Trial("after/cube.stl");
  ExpectRefused(cube + "--protocol none", "--protocol");
  ExpectRefused(cube + "--friction -0.1", "--friction");
  ExpectRefused(cube + "--mass -1", "--mass");
  ExpectRefused(cube + "--equal-mass 0", "--equal-mass");
  ExpectRefused(cube + "--equal-mass 0.1", "nothing is compared (--equal-mass)");
  ExpectRefused(cube + "--time-step 0.1", "--time-step");
  ExpectRefused(cube + "--friction 0.3 --friction-angle 20", "excludes");
  ExpectRefused(cube + "--min-epsilon 0.1", "--engine model");
  ExpectRefused(cube + "--series 3", "protocol six-ways has no such thing (--series 3)");
  ExpectRefused(cube + "--protocol paper", "protocol paper has no such thing (--draws 2)");
  ExpectRefused(cube + "--protocol dexgraspbench --table-friction 1", "a protocol with a table");
  ExpectRefused(cube + "--pad-width 0.01", "--tip pad");
  ExpectRefused(cube + "--tip pad --tip-radius 0.01", "--tip sphere");
  ExpectRefused("trial " + File("after/cube.stl") + " --engine model --protocol paper",
                "--engine mujoco");
  ExpectRefused("trial " + File("after/cube.stl") + " --engine model --tip pad", "--tip pad");
}

// The jaws' speed settles up to 0.04 m/s * 1 kg / 1 ms = 40 N. A heavier finger carries more.
TEST_F(TrialPhysicsCli, AForceThatShakesTheJawsIsRefused) {
  const std::string cube = Trial("after/cube.stl") + "--noise none --out " + File("t");
  ExpectRefused(cube + " --force 40.1", "at most 40 N");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "t"));
  Run(cube + " --force 100 --finger-mass 4");
  EXPECT_EQ(Table(folder_ / "t" / "trials.csv")[0]["held"], "1");
}

}  // namespace
}  // namespace antigrasp
