// --hardest N: the lowest of many noisy scores is too low, and a second one is not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::CsvRows;
using shapes::TempFolder;
using Table = std::vector<std::map<std::string, std::string>>;

constexpr int kCopies = 60, kHardest = 10;
constexpr const char* kNoisy = " --seed 3 --num-grasps 25 --num-draws 3 ";

// One shape under many names: all have the same true score.
void WriteCopies(const TempFolder& folder) {
  fs::create_directory(folder / "in");
  for (int i = 0; i < kCopies; ++i) {
    WriteMesh(folder / "in" / ("copy-" + std::to_string(100 + i) + ".stl"),
              shapes::Torus(1.0, 0.4, 24, 12));
  }
}

std::vector<double> ValuesIn(const Table& rows, const std::string& name) {
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(std::stod(row.at(name)));
  return values;
}

TEST(HardestCli, ScoresThatChoseAreTooLowAndFreshOnesAreNot) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteCopies(folder);
  ASSERT_EQ(Antigrasp("evaluate " + dir + "in" + kNoisy + "--out " + dir + "all.csv").code, 0);
  const Outcome outcome =
      Antigrasp("evaluate " + dir + "in --hardest 10" + kNoisy + "--out " + dir + "s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Table all = CsvRows(folder / "all.csv"), rows = CsvRows(folder / "s.csv");
  ASSERT_EQ(rows.size(), std::size_t{kHardest});
  std::vector<double> scores = ValuesIn(all, "graspability");
  const MeanInterval truth = MeanWithInterval(scores);
  const double deviation = truth.half_width / 1.96 * std::sqrt(double{kCopies});
  const std::vector<double> first = ValuesIn(rows, "graspability"),
                            fresh = ValuesIn(rows, "graspability_fresh_draws");
  // They are the lowest, lowest first.
  std::sort(scores.begin(), scores.end());
  EXPECT_EQ(first, std::vector<double>(scores.begin(), scores.begin() + kHardest));
  // The lowest sixth of a normal distribution lies 1.5 deviations too low, the mean of ten other
  // draws deviates by a third of one.
  EXPECT_LT(MeanWithInterval(first).mean, truth.mean - deviation);
  EXPECT_NEAR(MeanWithInterval(fresh).mean, truth.mean, 0.8 * deviation);
  for (const auto& row : rows) {
    EXPECT_LE(std::stod(row.at("fresh_ci_low")), std::stod(row.at("graspability_fresh_draws")));
    EXPECT_GE(std::stod(row.at("fresh_ci_high")), std::stod(row.at("graspability_fresh_draws")));
  }
  const std::string text = "the 10 hardest of 60: mean graspability " +
                           MeanText(MeanWithInterval(first), 5) +
                           " by the scores that chose them, " +
                           MeanText(MeanWithInterval(fresh), 5) + " under fresh draws\n";
  EXPECT_NE(outcome.text.find(text), std::string::npos) << text << outcome.text;
}

TEST(HardestCli, ExportWritesThemWithBothScores) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/ball.stl", shapes::Sphere(1.0, 3));  // the easiest
  WriteMesh(folder / "in/bar.stl", shapes::Box({1.0, 1.2, 8.0}));
  WriteMesh(folder / "in/ring.stl", shapes::Torus(1.0, 0.4, 24, 12));
  WriteMesh(folder / "in/sheet.stl", shapes::FlatSquare());
  const std::string hardest = " --hardest 2" + std::string(kNoisy);
  ASSERT_EQ(Antigrasp("evaluate " + dir + "in" + hardest + "--out " + dir + "s.csv").code, 0);
  const Outcome outcome = Antigrasp("export " + dir + "in" + hardest + "--out " + dir + "print");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  Table expected = CsvRows(folder / "s.csv"), rows = CsvRows(folder / "print/hardest.csv");
  const Table printed = CsvRows(folder / "print/print.csv");
  ASSERT_EQ(rows.size(), 2U);
  ASSERT_EQ(printed.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    rows[i]["seconds"] = expected[i]["seconds"] = "";
    EXPECT_EQ(rows[i], expected[i]);
    EXPECT_EQ(printed[i].at("object"), rows[i]["object"]);
    EXPECT_NE(rows[i]["object"], "ball.stl");
    const std::string file = fs::path(rows[i]["object"]).stem().string() + ".stl";
    EXPECT_TRUE(fs::exists(folder / "print" / file)) << file;
  }
  EXPECT_FALSE(fs::exists(folder / "print/ball.stl"));
  const std::string toml = ReadFile(folder / "print/hardest.csv.metric.toml");
  EXPECT_NE(toml.find("num_grasps = 25"), std::string::npos) << toml;
  EXPECT_NE(outcome.text.find("the 2 hardest of 4: "), std::string::npos) << outcome.text;
}

TEST(HardestCli, AnObjectWithoutAGraspIsNoWinnerAndIsNamed) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/bar.stl", shapes::Box({30.0, 35.0, 90.0}));
  WriteMesh(folder / "in/ball.stl", shapes::Sphere(15.0, 3));
  WriteMesh(folder / "in/wide.stl", shapes::Box({90.0, 95.0, 99.0}));
  WriteMesh(folder / "in/sheet.stl", shapes::FlatSquare());
  const std::string hardest = "in --hardest 2 --true-size --units mm" + std::string(kNoisy);
  for (const std::string command : {"evaluate ", "export "}) {
    const std::string out = command == "export " ? "e" : "s.csv";
    const Outcome outcome = Antigrasp(command + dir + hardest + "--out " + dir + out);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const Table rows = CsvRows(folder / (command == "export " ? "e/hardest.csv" : "s.csv"));
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].at("object"), "bar.stl") << command;
    EXPECT_EQ(rows[1].at("object"), "ball.stl") << command;
    for (const char* text :
         {"not among them, as they offer no grasp: 1: wide.stl\n",
          "not among them, as they have no score: 1\n", "3 objects scored, 1 not",
          "wide.stl: no grasp, everything is wider than the opening of 50 mm",
          "not scored: sheet.stl: "}) {
      EXPECT_NE(outcome.text.find(text), std::string::npos) << text << outcome.text;
    }
  }
  EXPECT_FALSE(fs::exists(folder / "e/wide.stl"));
  const Outcome none = Antigrasp("export " + dir + "in/wide.stl --hardest 1 --true-size " +
                                 "--units mm --out " + dir + "none");
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_NE(none.text.find("no object has a grasp; 1: wide.stl"), std::string::npos) << none.text;
  EXPECT_FALSE(fs::exists(folder / "none"));
}

TEST(HardestCli, WinnersOfALargeSetAreScoredAgainAsFewObjectsAre) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  for (int i = 0; i < 101; ++i) {
    WriteMesh(folder / "in" / (std::to_string(i) + ".stl"),
              shapes::Box({1.0, 1.2, 1.0 + 0.01 * i}));
  }
  const std::string evaluate = "evaluate " + dir + "in --num-draws 2 --hardest 2 --out " + dir;
  const Outcome outcome = Antigrasp(evaluate + "s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find(" under fresh draws of 1000 grasps\n"), std::string::npos)
      << outcome.text;
  EXPECT_NE(outcome.text.find("100 grasps an object, as there are more than 100 objects\n"),
            std::string::npos)
      << outcome.text;
  for (const auto& row : CsvRows(folder / "s.csv")) {
    EXPECT_EQ(row.at("num_grasps"), "100");
    // Ten times the grasps, a third of the interval.
    EXPECT_LT(std::stod(row.at("fresh_ci_high")) - std::stod(row.at("fresh_ci_low")),
              0.7 * (std::stod(row.at("ci_high")) - std::stod(row.at("ci_low"))));
  }
  const Outcome told = Antigrasp(evaluate + "t.csv --num-grasps 20");
  EXPECT_NE(told.text.find(" under fresh draws\n"), std::string::npos) << told.text;
}

TEST(HardestCli, RefusesWhatItCannotDoAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ring.stl", shapes::Torus(1.0, 0.4, 24, 12));
  WriteMesh(folder / "sheet.stl", shapes::FlatSquare());
  const std::string ring = dir + "ring.stl ";
  ExpectRefused("evaluate " + ring + "--hardest 0", "--hardest");
  ExpectRefused("evaluate " + ring + "--hardest 1 --grasps " + dir + "g.csv", "--hardest");
  ExpectRefused("evaluate " + ring + "--hardest 1 --baseline " + ring, "--hardest");
  ExpectRefused("export " + ring + "--friction 0.3 --out " + dir + "p", "--hardest N");
  ExpectRefused("export " + ring + "--seed 2 --out " + dir + "p", "--hardest");
  const Outcome none = Antigrasp("export " + dir + "sheet.stl --hardest 1 --out " + dir + "p");
  EXPECT_EQ(none.code, 2) << none.text;
  EXPECT_NE(none.text.find("no object scored"), std::string::npos) << none.text;
  for (const char* name : {"g.csv", "p"}) EXPECT_FALSE(fs::exists(folder / name)) << name;
}

}  // namespace
}  // namespace antigrasp
