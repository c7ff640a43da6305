// --units and --true-size of every command that takes them.
#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::CsvRows;
using shapes::TempFolder;

constexpr const char* kFewGrasps = " --num-grasps 12 --num-draws 3 ";

bool Says(const Outcome& outcome, const std::string& text) {
  return outcome.text.find(text) != std::string::npos;
}

double AsNumber(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::stod(row.at(name));
}

// A folder with a box of 25 x 30 x 80 mm, away from the origin, in a file of every unit.
class UnitsCli : public testing::Test {
 protected:
  void SetUp() override {
    const TriangleMesh box = Transformed(shapes::Box({25.0, 30.0, 80.0}), 1.0, {10.0, 20.0, 30.0});
    WriteMesh(folder / "mm.obj", box);
    WriteMesh(folder / "in.obj", box, 1.0 / 25.4);
    WriteMesh(folder / "m.obj", box, 0.001);
  }
  std::string File(const std::string& name) const { return (folder / name).string() + " "; }

  TempFolder folder;
};

TEST_F(UnitsCli, EvaluateScoresTheSameObjectInEveryUnitAndSaysItsSize) {
  for (const std::string unit : {"mm", "in", "m"}) {
    // Of one name, so that all meet the same draws.
    std::filesystem::create_directory(folder / unit);
    std::filesystem::copy(folder / (unit + ".obj"), folder / unit / "box.obj");
    const Outcome outcome = Antigrasp(
        "evaluate " + File(unit + "/box.obj") + kFewGrasps + "--true-size --units " + unit +
        " --out " + File(unit + ".csv") + "--grasps " + File(unit + ".grasps.csv"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(Says(outcome, ", at true size (" + unit + ")\n")) << outcome.text;
    EXPECT_NE(ReadFile(folder / (unit + ".csv.metric.toml")).find("units = '" + unit + "'"),
              std::string::npos);
  }
  const auto mm = CsvRows(folder / "mm.csv").front(), in = CsvRows(folder / "in.csv").front(),
             m = CsvRows(folder / "m.csv").front();
  EXPECT_GT(AsNumber(m, "graspability"), 0.0);
  for (const auto& row : {mm, in}) {
    EXPECT_NEAR(AsNumber(row, "graspability"), AsNumber(m, "graspability"), 1e-6);
  }
  EXPECT_EQ(mm.at("metres_per_unit"), "0.001");
  EXPECT_EQ(in.at("metres_per_unit"), "0.0254");
  EXPECT_EQ(m.at("metres_per_unit"), "1");
  EXPECT_EQ(mm.at("extent_x"), "25");
  EXPECT_EQ(mm.at("extent_y"), "30");
  EXPECT_EQ(mm.at("extent_z"), "80");
  EXPECT_NEAR(AsNumber(in, "extent_z"), 80.0 / 25.4, 1e-9);
  // Contacts in metres, where they lie in the file.
  for (const auto& grasp : CsvRows(folder / "mm.grasps.csv")) {
    EXPECT_GT(AsNumber(grasp, "p1x"), -0.0025 - 1e-9);  // 10 mm less half of 25 mm
    EXPECT_LT(AsNumber(grasp, "p1x"), 0.0225 + 1e-9);
    EXPECT_EQ(grasp.at("metres_per_unit"), "0.001");
  }
}

TEST_F(UnitsCli, EvaluateRescalesByDefaultAndSaysSo) {
  const Outcome plain =
      Antigrasp("evaluate " + File("mm.obj") + kFewGrasps + "--out " + File("s.csv"));
  ASSERT_EQ(plain.code, 0) << plain.text;
  EXPECT_TRUE(Says(plain, ", each scaled to a smallest extent of 40 mm\n")) << plain.text;
  const auto row = CsvRows(folder / "s.csv").front();
  EXPECT_EQ(row.at("metres_per_unit"), "0.0016");  // 40 mm of 25
  EXPECT_EQ(row.at("extent_z"), "80");
  const Outcome unit =
      Antigrasp("evaluate " + File("mm.obj") + kFewGrasps + "--units mm --out " + File("unit.csv"));
  ASSERT_EQ(unit.code, 0) << unit.text;
  EXPECT_TRUE(Says(unit,
                   "--units mm changes nothing while objects are each scaled to a smallest "
                   "extent of 40 mm; --true-size keeps their size"))
      << unit.text;
  EXPECT_EQ(CsvRows(folder / "unit.csv").front().at("graspability"), row.at("graspability"));
}

TEST_F(UnitsCli, AnUnscoredObjectHasNoSize) {
  WriteMesh(folder / "open.stl", shapes::FlatSquare());
  ASSERT_EQ(Antigrasp("evaluate " + File("open.stl") + File("mm.obj") + kFewGrasps + "--out " +
                      File("s.csv"))
                .code,
            0);
  const auto row = CsvRows(folder / "s.csv").front();
  for (const char* column : {"metres_per_unit", "extent_x", "extent_y", "extent_z"}) {
    EXPECT_EQ(row.at(column), "") << column;
  }
}

TEST_F(UnitsCli, SizesThatSpeakForAnotherUnitAreWarnedOf) {
  const std::string large = "mm.obj: largest extent 80 m: are the coordinates in mm? --units mm";
  const std::string out = "--out " + File("out");
  for (const std::string command :
       {"evaluate ", "perturb random ", "trial --engine model ", "export "}) {
    const Outcome outcome = Antigrasp(command + File("mm.obj") + "--true-size " + out +
                                      (command.starts_with("trial") ? " --series 1" : ""));
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(Says(outcome, large)) << command << outcome.text;
    std::filesystem::remove_all(folder / "out");
  }
  // An opening that no palm carries is refused, by the same words.
  const std::string metres =
      "--jaw-opening 85 is 85 m: the metric's lengths are in metres, 85 mm are 0.085";
  ExpectRefused("evaluate " + File("mm.obj") + "--jaw-opening 85", metres);
  const Outcome jaws = Antigrasp("evaluate " + File("mm.obj") + kFewGrasps +
                                 "--collision jaws --jaw-opening 85 " + out);
  EXPECT_EQ(jaws.code, 0) << jaws.text;
  EXPECT_TRUE(Says(jaws, metres)) << jaws.text;
  const Outcome wide = Antigrasp("evaluate " + File("mm.obj") + kFewGrasps +
                                 "--true-size --units mm --jaw-opening 0.02 " + out);
  EXPECT_EQ(wide.code, 0) << wide.text;
  EXPECT_TRUE(Says(wide,
                   "mm.obj: no grasp, everything is wider than the opening of 20 mm (25 mm "
                   "x 30 mm x 80 mm)"))
      << wide.text;
  const Outcome fine =
      Antigrasp("evaluate " + File("mm.obj") + kFewGrasps + "--true-size --units mm " + out);
  EXPECT_FALSE(Says(fine, "--units")) << fine.text;
}

TEST_F(UnitsCli, PerturbScoresAtTrueSizeAndWritesInTheUnitOfTheInput) {
  WriteMesh(folder / "ball.obj", Transformed(shapes::Sphere(15.0, 2), 1.0, {50.0, 0.0, 0.0}));
  for (const std::string method : {"random", "search --steps 8 --grasps 10"}) {
    const Outcome outcome = Antigrasp("perturb " + method + " " + File("ball.obj") + kFewGrasps +
                                      "--true-size --units mm --out " + File("p"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const BoundingBox after = Bounds(ReadMesh(folder / "p/after/ball.stl"));
    EXPECT_NEAR(after.Extent().x(), 30.0, 1.5) << method;
    EXPECT_NEAR(after.Center().x(), 50.0, 1.0) << method;
    ASSERT_EQ(Antigrasp("evaluate " + File("p/before") + kFewGrasps +
                        "--true-size --units mm --out " + File("s.csv"))
                  .code,
              0);
    const double before = AsNumber(CsvRows(folder / "s.csv").front(), "graspability");
    EXPECT_GT(before, 0.0);
    EXPECT_NEAR(AsNumber(CsvRows(folder / "p/perturb.csv").front(), "graspability_before"), before,
                1e-12);
    std::filesystem::remove_all(folder / "p");
  }
}

TEST_F(UnitsCli, ExportWritesMillimetresAtTrueSize) {
  const Outcome outcome = Antigrasp("export " + File("in.obj") +
                                    "--true-size --units in --format off --out " + File("e"));
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(Says(outcome, "1 of 1 objects in " + (folder / "e").string() + ", at true size (in)"))
      << outcome.text;
  const Eigen::Vector3d extent = Bounds(ReadMesh(folder / "e/in.off")).Extent();
  EXPECT_LT((extent - Eigen::Vector3d(25.0, 30.0, 80.0)).norm(), 1e-6) << extent.transpose();
  EXPECT_NEAR(AsNumber(CsvRows(folder / "e/print.csv").front(), "size_z_mm"), 80.0, 1e-6);
}

TEST_F(UnitsCli, PosesAndTrialsKnowTheUnit) {
  ASSERT_EQ(Antigrasp("poses " + File("mm.obj") + "--units mm --out " + File("p.csv")).code, 0);
  const auto rows = CsvRows(folder / "p.csv");
  EXPECT_EQ(rows.size(), 6u);
  for (const auto& row : rows) {  // half of 25, 30 or 80 mm
    const double height = AsNumber(row, "com_height");
    EXPECT_TRUE(std::abs(height - 0.0125) < 1e-6 || std::abs(height - 0.015) < 1e-6 ||
                std::abs(height - 0.04) < 1e-6)
        << height;
  }
  const std::string trial =
      "trial --engine model " + File("mm.obj") + kFewGrasps + "--series 2 --out ";
  ASSERT_EQ(Antigrasp(trial + File("short.csv") + "--mm").code, 0);
  ASSERT_EQ(Antigrasp(trial + File("long.csv") + "--units mm --true-size").code, 0);
  ASSERT_EQ(Antigrasp(trial + File("scaled.csv")).code, 0);
  EXPECT_EQ(ReadFile(folder / "short.csv"), ReadFile(folder / "long.csv"));
  EXPECT_NE(ReadFile(folder / "short.csv"), ReadFile(folder / "scaled.csv"));
  EXPECT_EQ(ReadFile(folder / "short.csv.trial.toml"), ReadFile(folder / "long.csv.trial.toml"));
}

TEST_F(UnitsCli, CompareMeasuresInMetres) {
  for (const char* name : {"a/1.obj", "a/2.obj", "b/1.obj", "b/2.obj"}) {
    std::filesystem::create_directories((folder / name).parent_path());
    const double size = 10.0 + name[2] + 3.0 * name[0];
    WriteMesh(folder / name, shapes::Box({size, 2.0 * size, 20.0}));
  }
  const std::string compare = "compare " + File("a") + File("b") + "--points 64 --out ";
  ASSERT_EQ(Antigrasp(compare + File("m.csv")).code, 0);
  ASSERT_EQ(Antigrasp(compare + File("cm.csv") + "--units cm").code, 0);
  const auto m = CsvRows(folder / "m.csv"), cm = CsvRows(folder / "cm.csv");
  ASSERT_EQ(m.size(), cm.size());
  int lengths = 0;
  for (std::size_t i = 0; i < m.size(); ++i) {
    if (m[i].at("measure") != "size") continue;
    EXPECT_NEAR(AsNumber(cm[i], "samples"), 0.01 * AsNumber(m[i], "samples"), 1e-9);
    EXPECT_GT(AsNumber(cm[i], "samples"), 0.0);
    ++lengths;
  }
  EXPECT_EQ(lengths, 1);
}

// A box of 25 x 30 x 80, to a third of a node of 80 / 28.
void ExpectTheBox(const Eigen::Vector3d& extent, const std::string& where) {
  EXPECT_LT((extent - Eigen::Vector3d(25.0, 30.0, 80.0)).cwiseAbs().maxCoeff(), 1.0)
      << where << extent.transpose();
}

TEST_F(UnitsCli, AnImportedSetHasTheTrueSizeOfItsFilesInEveryCommand) {
  const std::string set = File("set.h5"), true_size = "--true-size --units mm --out ";
  ASSERT_EQ(Antigrasp("dataset import " + File("mm.obj") + "--out " + set).code, 0);
  ASSERT_EQ(Antigrasp("evaluate " + set + kFewGrasps + true_size + File("s.csv")).code, 0);
  const auto score = CsvRows(folder / "s.csv").front();
  EXPECT_EQ(score.at("metres_per_unit"), "0.001");
  ExpectTheBox(
      {AsNumber(score, "extent_x"), AsNumber(score, "extent_y"), AsNumber(score, "extent_z")},
      "evaluate");
  ASSERT_EQ(Antigrasp("perturb random " + set + kFewGrasps + "--iterations 0 --subdivide 100 " +
                      true_size + File("p"))
                .code,
            0);
  ExpectTheBox(Bounds(ReadMesh(folder / "p/before/mm.stl")).Extent(), "perturb");
  // To what single precision leaves of an STL file.
  EXPECT_NEAR(AsNumber(CsvRows(folder / "p/perturb.csv").front(), "graspability_before"),
              AsNumber(score, "graspability"), 0.05 * AsNumber(score, "graspability"));
  ASSERT_EQ(Antigrasp("export " + set + true_size + File("e")).code, 0);
  ExpectTheBox(Bounds(ReadMesh(folder / "e/mm.stl")).Extent(), "export");
  ASSERT_EQ(Antigrasp("poses " + set + "--units mm --out " + File("poses.csv")).code, 0);
  for (const auto& row : CsvRows(folder / "poses.csv")) {
    EXPECT_GT(AsNumber(row, "com_height"), 0.011);
    EXPECT_LT(AsNumber(row, "com_height"), 0.042);
  }
  // What the warnings say of sizes is of the same one.
  const Outcome metres = Antigrasp("evaluate " + set + kFewGrasps + "--true-size");
  EXPECT_TRUE(Says(metres, " m: are the coordinates in mm? --units mm")) << metres.text;
  // Without one factor for the set there is the cube alone.
  ASSERT_EQ(
      Antigrasp("dataset import " + File("mm.obj") + "--scale each --out " + File("each.h5")).code,
      0);
  ASSERT_EQ(
      Antigrasp("evaluate " + File("each.h5") + kFewGrasps + "--true-size --out " + File("s.csv"))
          .code,
      0);
  EXPECT_LT(AsNumber(CsvRows(folder / "s.csv").front(), "extent_z"), 1.0);
}

TEST_F(UnitsCli, WhatDoesNotGoTogetherIsRefused) {
  const std::string out = "--out " + File("o");
  ExpectRefused("evaluate " + File("mm.obj") + "--units inch " + out,
                "metric.units = 'inch' (--units): expected one of mm, cm, m, in");
  ExpectRefused("evaluate " + File("mm.obj") + "--true-size --object-min-extent 0.03 " + out,
                "--object-min-extent excludes --true-size");
  ExpectRefused("trial " + File("mm.obj") + "--mm --units in " + out, "--mm excludes --units");
  ExpectRefused("export " + File("mm.obj") + "--units mm " + out, "--units requires --true-size");
  ExpectRefused("export " + File("mm.obj") + "--true-size --size-mm 50 " + out, "--true-size");
  EXPECT_FALSE(std::filesystem::exists(folder / "o"));
}

}  // namespace
}  // namespace antigrasp
