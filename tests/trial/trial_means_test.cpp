// means.csv as it is written and read, and the folders of several trials as one table.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "antigrasp/core/error.h"
#include "antigrasp/trial/trial_folders.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const std::string kHeader =
    "protocol,masses,friction,stage,grasps,objects,held,held_half_width,held_before,pairs,"
    "difference,difference_half_width,held_before_half_width\n";

TrialSummary Held(double first, double second, double third) {
  TrialSummary one;
  one.status = "ok";
  for (const double share : {first, second, third}) one.held.push_back({share, {}});
  return one;
}

std::string Means(double friction, const std::string& masses, const std::string& held) {
  const std::string start = "six-ways," + masses + "," + std::to_string(friction) + ",";
  return start + "1 g,all,50," + held + ",2,70,49,-5,1,3\n" + start +
         "1 g,best,50,99,2,98,49,1,1,3\n" + start + "8 g,all,50,20,2,30,49,-10,1,3\n";
}

std::string Judge(const std::string& tip = "sphere", const std::string& radius = "0.005") {
  return "engine = \"mujoco 2.2.2\"\nfrictions = [0.5]\nequal_mass = 0.05\n\n[metric]\nfriction = "
         "0.5\n\n[trial]\nmass = 0.0\ntip = '" +
         tip + "'\ntip_radius = " + radius + "\n";
}

std::string WhyNot(const std::vector<std::string>& folders) {
  try {
    ReadTrialFolders(folders);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Held 40 and 60 of 100 where the originals are 90 and 70, and 50 beside no original: means 50 and
// 80, differences -50 and -10. Half widths of two values that differ by d: 1.96 d / 2.
TEST(MeansTable, SetsAHalfWidthBesideTheMeanOfTheOriginals) {
  MeansTable table;
  table.Add({"six-ways", "after", "own", 0.25}, ProtocolOf(ProtocolName::kSixWays),
            {Held(0.4, 0.3, 0.2), Held(0.6, 0.3, 0.2), Held(0.5, 0.3, 0.2)},
            {Held(0.9, 0.8, 0.7), Held(0.7, 0.8, 0.7), Held(kNan, kNan, kNan)});
  EXPECT_EQ(table.text().substr(0, kHeader.size()), kHeader);
  const TempFolder folder;
  const TrialMean row = ReadTrialMeans(folder.Write("means.csv", table.text())).front();
  EXPECT_EQ(row.protocol + ' ' + row.masses + ' ' + row.stage + ' ' + row.grasps,
            "six-ways own 1 g all");
  EXPECT_EQ(row.friction, 0.25);
  EXPECT_NEAR(row.held.mean, 50.0, 1e-9);
  EXPECT_EQ(row.held.count, 3);
  EXPECT_NEAR(row.before.mean, 80.0, 1e-9);
  EXPECT_NEAR(row.before.half_width, 19.6, 1e-3);
  EXPECT_NEAR(row.difference.mean, -30.0, 1e-9);
  EXPECT_NEAR(row.difference.half_width, 39.2, 1e-3);
  EXPECT_EQ(row.difference.count, 2);
}

// Of four pairs one has no grasp after and one none before: what is left loses 30 and 10 points of
// 90 and 70.
TEST(TrialDifference, CountsThePairsThatItLeavesOutByTheirReasons) {
  std::vector<TrialSummary> after = {Held(0.6, 0.3, 0.2), Held(kNan, kNan, kNan),
                                     Held(0.6, 0.3, 0.2), Held(0.5, 0.3, 0.2)};
  std::vector<TrialSummary> before = {Held(0.9, 0.8, 0.7), Held(0.1, 0.8, 0.7), Held(0.7, 0.8, 0.7),
                                      Held(kNan, kNan, kNan)};
  after[1].status = "no reachable grasp";
  before[3].status = "open: 3 boundary edges";
  const Protocol protocol = ProtocolOf(ProtocolName::kSixWays);
  const std::string text = TrialDifference(after, before, protocol);
  EXPECT_TRUE(text.starts_with("1 g -20.0 +-19.6 points of 80.0, 3 g -50.0 +-0.0 points of 80.0"))
      << text;
  EXPECT_TRUE(text.ends_with("(2 pairs; not paired: 1 after: no reachable grasp, 1 before: open)"))
      << text;
  EXPECT_NE(TrialMeans(before, protocol).find("(mean over 3 of 4 objects; not in it: 1 open)"),
            std::string::npos);
  EXPECT_NE(TrialMeans({after[0]}, protocol).find("(mean over 1 of 1 objects)"), std::string::npos);
}

// The same column is about force closure, or about what holds once it has settled.
TEST(TrialLines, NamesItsLastColumnByWhatTheMetricLooksAt) {
  const Protocol protocol = ProtocolOf(ProtocolName::kSixWays);
  MetricOptions metric;
  const auto header = [&] {
    const std::string text = TrialLines({}, protocol, metric);
    return text.substr(0, text.find('\n'));
  };
  EXPECT_TRUE(header().ends_with("   best    top  force closure")) << header();
  ApplyMetricPreset("settled", &metric);
  EXPECT_TRUE(header().ends_with("   best    top  settled holds")) << header();
}

TEST(ReadTrialRows, TakesBackEveryNumberOfARow) {
  const TempFolder folder;
  const Protocol protocol = ProtocolOf(ProtocolName::kSixWays);
  TrialSummary one = Held(1.0 / 3.0, 0.25, 0.125);
  one.object = "a, \"b\".stl";
  one.mass = 0.1;
  one.poses = 6, one.wanted = 7, one.candidates = 30, one.grasps = 5, one.executions = 12;
  for (std::size_t i = 0; i < 3; ++i) one.held[i].interval = {0.1 * double(i), 0.7};
  one.group = {1.0 / 3.0, 0.5, 1.0 / 7.0, kNan};
  one.outcomes = {4, 1, 2, 0, 3, 1, 1};
  one.untrusted = 2, one.predicted = 0.9, one.quality = 1e-3;
  TrialSummary none = NotTried("none.stl", "no reachable grasp", protocol);
  const TrialRun run{"six-ways", "before", "equal", 0.1};
  TrialsTable table(protocol), again(protocol);
  table.Add(run, one);
  table.Add(run, none);
  const auto path = folder.Write("trials.csv", table.text());
  const std::vector<TrialRow> rows = ReadTrialRows(path, protocol);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].summary.outcomes, one.outcomes);
  EXPECT_EQ(rows[0].run, run);
  for (const TrialRow& row : rows) again.Add(row.run, row.summary);
  EXPECT_EQ(again.text(), table.text());
  EXPECT_THROW(ReadTrialRows(path, ProtocolOf(ProtocolName::kPaper)), InputError);
}

TEST(ReadTrialMeans, TakesEveryColumnByItsNameAndAnEmptyFieldForAGap) {
  const TempFolder folder;
  const auto path = folder.Write(
      "means.csv",
      "held,held_half_width,pairs,objects,difference,difference_half_width,held_before,grasps,"
      "stage,friction,masses,protocol\n1,2,3,4,5,6,7,all,8 g,0.5,equal,paper\n"
      ",,0,0,,,,all,8 g,0.25,equal,paper\n");
  const std::vector<TrialMean> rows = ReadTrialMeans(path);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].held.mean, 1.0);
  EXPECT_EQ(rows[0].held.half_width, 2.0);
  EXPECT_EQ(rows[0].held.count, 4);
  EXPECT_EQ(rows[0].before.mean, 7.0);
  EXPECT_TRUE(std::isnan(rows[0].before.half_width));  // a table of an earlier version
  EXPECT_EQ(rows[0].before.count, 3);
  EXPECT_EQ(rows[0].difference.mean, 5.0);
  EXPECT_EQ(rows[0].difference.half_width, 6.0);
  EXPECT_EQ(rows[0].masses, "equal");
  EXPECT_TRUE(std::isnan(rows[1].held.mean));
}

TEST(ReadTrialFolders, JoinsFrictionsAndSaysWhoJudged) {
  const TempFolder folder;
  folder.Write("a/means.csv", kHeader + Means(0.5, "own", "60"));
  folder.Write("a/trial.toml", Judge());
  folder.Write("b/means.csv", kHeader + Means(0.25, "own", "40") + Means(0.25, "equal", "45"));
  folder.Write("b/trial.toml", Judge());
  const TriedFolders all = ReadTrialFolders({(folder / "a").string(), (folder / "b").string()});
  EXPECT_EQ(all.judge.engine, "mujoco 2.2.2");
  EXPECT_EQ(all.judge.protocol, "six-ways");
  EXPECT_EQ(all.judge.tip, "sphere of 5 mm");
  EXPECT_EQ(all.judge.equal_mass, 0.05);
  ASSERT_EQ(all.rows.size(), 6u);  // those of all grasps
  EXPECT_EQ(all.rows[0].held.mean, 60.0);
  EXPECT_EQ(all.rows[2].held.mean, 40.0);
  EXPECT_EQ(all.rows[2].friction, 0.25);
  EXPECT_EQ(all.rows[4].held.mean, 45.0);
  EXPECT_EQ(all.rows[5].stage, "8 g");
  EXPECT_EQ(ReadTrialFolders({(folder / "a").string()}).judge.equal_mass, 0.0);
}

TEST(ReadTrialFolders, RefusesTwoJudgesAndAFrictionTwice) {
  const TempFolder folder;
  const std::string dir = folder.path().string();
  for (const char* name : {"a", "b"}) {
    folder.Write(std::string(name) + "/means.csv", kHeader + Means(0.5, "own", "60"));
    folder.Write(std::string(name) + "/trial.toml", Judge());
  }
  EXPECT_EQ(WhyNot({dir + "/a", dir + "/b"}), "friction 0.5, own mass once more (" + dir +
                                                  "/b/means.csv): expected each friction once; it "
                                                  "is in " +
                                                  dir + "/a, too");
  EXPECT_NE(WhyNot({dir + "/a", dir + "/a"}), "");
  folder.Write("b/means.csv", kHeader + Means(0.25, "own", "60"));
  EXPECT_EQ(WhyNot({dir + "/a", dir + "/b"}), "");
  folder.Write("b/trial.toml", Judge("sphere", "0.004"));
  EXPECT_EQ(WhyNot({dir + "/a", dir + "/b"}), "fingertip sphere of 4 mm (" + dir +
                                                  "/b): expected sphere of 5 mm, as in the first "
                                                  "folder");
  folder.Write("b/trial.toml", Judge("pad"));
  EXPECT_NE(WhyNot({dir + "/a", dir + "/b"}).find("pad of 20 x 20 mm"), std::string::npos);
}

TEST(ReadTrialFolders, RefusesACutTableOneOfAnotherKindAndNone) {
  const TempFolder folder;
  const std::string dir = folder.path().string(), table = dir + "/a/means.csv";
  folder.Write("a/trial.toml", Judge());
  EXPECT_NE(WhyNot({dir + "/a"}).find(table), std::string::npos);
  const std::string whole = kHeader + Means(0.5, "own", "60");
  folder.Write("a/means.csv", whole.substr(0, whole.size() - 9));
  EXPECT_NE(WhyNot({dir + "/a"}).find(table + ":4"), std::string::npos) << WhyNot({dir + "/a"});
  folder.Write("a/means.csv", kHeader);
  EXPECT_EQ(WhyNot({dir + "/a"}), "no rows (" + table + "): expected means.csv of antigrasp trial");
  folder.Write("a/means.csv", "object,status,graspability\nmug,ok,0.5\n");
  EXPECT_NE(WhyNot({dir + "/a"}).find("protocol"), std::string::npos) << WhyNot({dir + "/a"});
  folder.Write("a/means.csv", kHeader + Means(0.5, "own", "160"));
  EXPECT_EQ(WhyNot({dir + "/a"}), "held = 160 (" + table + ":2): expected a number in [0, 100]");
  folder.Write("a/means.csv", whole);
  EXPECT_EQ(WhyNot({dir + "/a"}), "");
  folder.Write("a/trial.toml", "seed = 1\n");
  EXPECT_NE(WhyNot({dir + "/a"}).find("no engine"), std::string::npos);
}

}  // namespace
}  // namespace antigrasp
