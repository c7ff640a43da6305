// A score belongs to the object: alone, in any folder, in any order, by any command.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::Outcome;
using shapes::CsvRows;
using shapes::TempFolder;

constexpr const char* kTwelve = " --seed 5 --num-grasps 12 --num-draws 3 ";

// a.stl and b.stl in one folder, another b.stl in a second one.
void WriteObjects(const TempFolder& folder) {
  fs::create_directories(folder / "in/deep");
  WriteMesh(folder / "in/a.stl", shapes::Box({1.0, 1.5, 2.0}));
  WriteMesh(folder / "in/b.stl", shapes::Torus(1.0, 0.4, 24, 12));
  WriteMesh(folder / "in/deep/b.stl", shapes::Cylinder(1.0, 3.0, 24));
}

// Graspabilities by object, in the column `column`.
std::map<std::string, std::string> ByObject(const fs::path& table, const std::string& column) {
  std::map<std::string, std::string> cells;
  for (const auto& row : CsvRows(table)) cells[row.at("object")] = row.at(column);
  return cells;
}

TEST(SameScoreCli, AloneInAFolderAndInAnyOrder) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteObjects(folder);
  const auto scores = [&](const std::string& objects) {
    const Outcome outcome = Antigrasp("evaluate " + objects + kTwelve + "--out " + dir + "s.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    const bool told = outcome.text.find("2 objects have one name and with it the same draws") !=
                      std::string::npos;
    EXPECT_EQ(told, CsvRows(folder / "s.csv").size() == 3U) << outcome.text;  // both b.stl
    return ByObject(folder / "s.csv", "graspability");
  };
  const std::string a = dir + "in/a.stl", b = dir + "in/b.stl", deep = dir + "in/deep/b.stl";
  auto all = scores(dir + "in");
  ASSERT_EQ(all.size(), 3U);
  ASSERT_NE(all["a.stl"], all["b.stl"]);
  EXPECT_EQ(scores(a)["a.stl"], all["a.stl"]);
  EXPECT_EQ(scores(b)["b.stl"], all["b.stl"]);
  EXPECT_EQ(scores(deep)["b.stl"], all["deep/b.stl"]);
  auto turned = scores(deep + " " + b + " " + a);
  EXPECT_EQ(turned["a.stl"], all["a.stl"]);
  EXPECT_EQ(turned["in/b.stl"], all["b.stl"]);
  EXPECT_EQ(turned["deep/b.stl"], all["deep/b.stl"]);
  // A number of another seed is another one.
  ASSERT_EQ(
      Antigrasp("evaluate " + a + " --seed 6 --num-grasps 12 --num-draws 3 --out " + dir + "s.csv")
          .code,
      0);
  EXPECT_NE(ByObject(folder / "s.csv", "graspability")["a.stl"], all["a.stl"]);
}

TEST(SameScoreCli, PerturbScoresItsInputAsEvaluateDoesAndItsResultsAreReadWithTheSameDraws) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteObjects(folder);
  fs::remove_all(folder / "in/deep");
  const Outcome outcome = Antigrasp("perturb random " + dir + "in --iterations-per-vertex 0.1" +
                                    kTwelve + "--out " + dir + "p");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  ASSERT_EQ(
      Antigrasp("evaluate " + dir + "p/before/b.stl" + kTwelve + "--out " + dir + "b.csv").code, 0);
  ASSERT_EQ(Antigrasp("evaluate " + dir + "p/after --baseline " + dir + "p/before" + kTwelve +
                      "--out " + dir + "s.csv")
                .code,
            0);
  auto before = ByObject(folder / "p/perturb.csv", "graspability_before");
  EXPECT_EQ(ByObject(folder / "b.csv", "graspability")["b.stl"], before["b.stl"]);
  EXPECT_EQ(ByObject(folder / "s.csv", "baseline"), before);
  EXPECT_EQ(ByObject(folder / "s.csv", "graspability"),
            ByObject(folder / "p/perturb.csv", "graspability_after"));
}

TEST(SameScoreCli, ATrialDoesNotDependOnNeighbours) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteObjects(folder);
  const auto held = [&](const std::string& objects) {
    const Outcome outcome =
        Antigrasp("trial --engine model " + objects + kTwelve + "--reading half-angle " +
                  "--series 2 --out " + dir + "t.csv");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return ByObject(folder / "t.csv", "confidence");
  };
  EXPECT_EQ(held(dir + "in")["b.stl"], held(dir + "in/b.stl")["b.stl"]);
}

TEST(SameScoreCli, AFewObjectsTakeAThousandGraspsUnlessToldOtherwise) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteObjects(folder);
  const std::string evaluate = "evaluate " + dir + "in/a.stl --out " + dir + "s.csv";
  const Outcome outcome = Antigrasp(evaluate);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("1000 grasps an object, as there are at most 100 objects\n"),
            std::string::npos)
      << outcome.text;
  auto row = CsvRows(folder / "s.csv").front();
  EXPECT_EQ(row["num_grasps"], "1000");
  const double score = std::stod(row["graspability"]), low = std::stod(row["ci_low"]),
               high = std::stod(row["ci_high"]);
  EXPECT_LT(high - score, 0.1 * score);
  EXPECT_LT(score - low, 0.1 * score);
  char text[128];
  std::snprintf(text, sizeof text,
                "\n95 %% interval over its grasps %.5f to %.5f, %+.1f to %+.1f %%\n", low, high,
                100.0 * (low / score - 1.0), 100.0 * (high / score - 1.0));
  EXPECT_NE(outcome.text.find(text), std::string::npos) << text << outcome.text;
  const std::string toml = ReadFile(folder / "s.csv.metric.toml");
  EXPECT_NE(toml.find("num_grasps = 1000"), std::string::npos) << toml;
  EXPECT_NE(toml.find("max_attempts = 40000"), std::string::npos) << toml;
  const auto grasps = [&](const std::string& flags) {
    const Outcome other = Antigrasp(evaluate + flags);
    EXPECT_EQ(other.text.find("grasps an object"), std::string::npos) << other.text;
    return CsvRows(folder / "s.csv").front()["num_grasps"];
  };
  EXPECT_EQ(grasps(" --num-grasps 50"), "50");
  EXPECT_EQ(grasps(" --preset default"), "100");
  EXPECT_EQ(grasps(" --max-attempts 4000"), "100");
  for (const char* command : {"evaluate", "export"}) {
    const std::string help = Antigrasp(std::string("help ") + command).text;
    EXPECT_NE(help.find("gets 1000 grasps"), std::string::npos) << help;
    EXPECT_NE(help.find("at most 100 objects"), std::string::npos) << help;
  }
}

TEST(SameScoreCli, AScoreStandsBesideKnownOnesAtTheirConstantsAlone) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  // Jaws find opposite points of a sphere everywhere: no object of any set is as easy to hold.
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 4));
  const std::string evaluate = "evaluate " + dir + "ball.stl --out " + dir + "s.csv";
  const Outcome known = Antigrasp(evaluate);
  EXPECT_NE(known.text.find("\nharder to grasp than 0 % of cylinders, "), std::string::npos)
      << known.text;
  EXPECT_NE(known.text.find(", 0 % of bottles-adversarial\n"), std::string::npos) << known.text;
  const std::string column = "harder_than_bottles_adversarial_pct";
  EXPECT_EQ(std::stod(CsvRows(folder / "s.csv").front().at(column)), 0.0);
  const Outcome other = Antigrasp(evaluate + " --friction 0.4");
  EXPECT_FALSE(CsvRows(folder / "s.csv").front().contains(column));
  EXPECT_NE(other.text.find("\nno known objects at these constants"), std::string::npos)
      << other.text;
  const Outcome none = Antigrasp(evaluate + " --torsion none");
  EXPECT_EQ(none.text.find("harder to grasp"), std::string::npos) << none.text;
}

TEST(SameScoreCli, AnOnlyPairHasAnIntervalOverGraspsAndSaysThatItIsOne) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteObjects(folder);
  const std::string out = " --seed 5 --num-grasps 400 --out " + dir + "s.csv";
  const Outcome pair =
      Antigrasp("evaluate " + dir + "in/b.stl --baseline " + dir + "in/a.stl" + out);
  ASSERT_EQ(pair.code, 0) << pair.text;
  EXPECT_NE(pair.text.find("b.stl and a.stl are taken as a pair, though their names differ"),
            std::string::npos)
      << pair.text;
  const auto row = CsvRows(folder / "s.csv").front();
  const double baseline = std::stod(row.at("baseline")),
               changed = std::stod(row.at("graspability"));
  const std::size_t at = pair.text.find("\npaired difference ");
  ASSERT_NE(at, std::string::npos) << pair.text;
  double difference = 0.0, low = 0.0, high = 0.0, percent = 0.0;
  ASSERT_EQ(
      std::sscanf(pair.text.c_str() + at,
                  "\npaired difference %lf, 95 %% interval over its grasps %lf to %lf, %lf %%",
                  &difference, &low, &high, &percent),
      4)
      << pair.text;
  EXPECT_NEAR(difference, changed - baseline, 6e-6);
  EXPECT_NEAR(percent, 100.0 * (changed - baseline) / baseline, 0.06);
  EXPECT_LT(low, difference);
  EXPECT_GT(high, difference);
  // Neither narrower than the changed one's own interval nor wider than both together.
  const double own = std::stod(row.at("ci_high")) - std::stod(row.at("ci_low"));
  EXPECT_GT(high - low, own);
  const Outcome same =
      Antigrasp("evaluate " + dir + "in/b.stl --baseline " + dir + "in/b.stl" + out);
  EXPECT_EQ(same.text.find("are taken as a pair"), std::string::npos) << same.text;
}

}  // namespace
}  // namespace antigrasp
