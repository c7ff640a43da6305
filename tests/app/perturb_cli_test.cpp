// The command perturb: files, exit codes, determinism.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::FileContents;
using shapes::TempFolder;

constexpr const char* kQuick = " --num-grasps 10 --num-draws 3 ";

// Rows by object, each a map from column to field; without quotes and commas inside.
std::map<std::string, std::map<std::string, std::string>> Rows(const fs::path& file) {
  std::istringstream lines(ReadFile(file));
  std::string line, field;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream header(line); std::getline(header, field, ',');) names.push_back(field);
  std::map<std::string, std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    std::map<std::string, std::string> row;
    std::istringstream fields(line);
    for (const std::string& name : names) {
      std::getline(fields, field, ',');
      row[name] = field;
    }
    rows[row["object"]] = row;
  }
  return rows;
}

TEST(PerturbCli, EveryMethodWritesSolidsTheOriginalsATableAndItsSettings) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/ball.stl", shapes::Sphere(1.0, 2));
  WriteMesh(folder / "in/rod.ply", shapes::Cylinder(1.0, 3.0, 24));
  for (const std::string method :
       {"exhaustive --iterations 3 --step 0.5", "random --alpha 15", "rotation --beta 0.3"}) {
    const fs::path out = folder / method.substr(0, 4);
    const Outcome outcome =
        Antigrasp("perturb " + method + " " + dir + "in --out " + out.string() + kQuick);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NE(outcome.text.find("2 of 2 objects perturbed: mean graspability"), std::string::npos);
    EXPECT_NE(outcome.text.find("kappa reduced by"), std::string::npos) << outcome.text;
    for (const char* name : {"ball", "rod"}) {
      const TriangleMesh mesh = ReadMesh(out / "after" / (std::string(name) + ".stl"));
      EXPECT_EQ(WhyNotSolid(Inspect(mesh)), "");
      const TriangleMesh before = ReadMesh(out / "before" / (std::string(name) + ".stl"));
      EXPECT_NE(before.vertices, mesh.vertices);
      EXPECT_NEAR(Volume(before), Volume(mesh), 0.2 * Volume(before));
    }
    auto rows = Rows(out / "perturb.csv");
    ASSERT_EQ(rows.size(), 2u);
    auto& ball = rows["ball.stl"];
    EXPECT_EQ(ball["status"], "ok");
    EXPECT_EQ(ball["faces_before"], "320");
    EXPECT_GT(std::stol(ball["pairs_before"]), 10000);  // a fifth of all pairs of a sphere
    EXPECT_NE(ball["pairs_after"], ball["pairs_before"]);
    EXPECT_GT(std::stol(ball["moved"]), 0);
    EXPECT_NEAR(std::stod(ball["difference"]),
                std::stod(ball["graspability_after"]) - std::stod(ball["graspability_before"]),
                1e-12);
    EXPECT_GT(std::stod(ball["hausdorff_pct"]), 0.0);
    EXPECT_LE(std::stod(ball["normal_max_deg"]), method.starts_with("random") ? 15.0 : 60.0);
    const std::string settings = ReadFile(out / "perturb.toml");
    EXPECT_NE(settings.find("num_draws = 3"), std::string::npos) << settings;
    EXPECT_NE(settings.find("[" + method.substr(0, method.find(' ')) + "]"), std::string::npos);
  }
}

TEST(PerturbCli, SearchLowersGraspabilityAndKeepsEveryNormalWithinAlpha) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make cylinders --count 2 --out " + dir + "c.h5").code, 0);
  const std::string search = "perturb search " + dir +
                             "c.h5 --alpha 15 --steps 60 --grasps 60 --num-grasps 50 --num-draws "
                             "10 --out " +
                             dir;
  const Outcome outcome = Antigrasp(search + "1 --threads 1");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("2 of 2 objects perturbed"), std::string::npos) << outcome.text;
  for (auto& [name, row] : Rows(folder / "1/perturb.csv")) {
    EXPECT_LT(std::stod(row["difference"]), 0.0) << name;
    EXPECT_GT(std::stod(row["normal_max_deg"]), 5.0);
    EXPECT_LE(std::stod(row["normal_max_deg"]), 15.0);
  }
  ASSERT_EQ(Antigrasp(search + "2 --threads 2").code, 0);
  EXPECT_TRUE(FileContents(folder / "1") == FileContents(folder / "2"));
}

TEST(PerturbCli, WritesTheSameBytesForAnyNumberOfThreadsAndOthersForAnotherSeed) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make bottles --count 2 --out " + dir + "b.h5").code, 0);
  const std::string common = " " + dir + "b.h5" + kQuick + "--out " + dir;
  const std::string random = "perturb random --iterations-per-vertex 0.5" + common;
  ASSERT_EQ(Antigrasp(random + "1 --threads 1").code, 0);
  ASSERT_EQ(Antigrasp(random + "2 --threads 3").code, 0);
  ASSERT_EQ(Antigrasp(random + "3 --seed 2").code, 0);
  const auto contents = FileContents(folder / "1");
  // 2 meshes, 2 originals, perturb.csv, perturb.toml, sheet.png, summary.csv
  EXPECT_EQ(contents.size(), 8u);
  EXPECT_EQ(contents.at("summary.csv"), Antigrasp("info " + dir + "1 --csv").text);
  EXPECT_TRUE(contents == FileContents(folder / "2"));
  EXPECT_FALSE(contents == FileContents(folder / "3"));
  const std::string rotation = "perturb rotation --history" + common;
  ASSERT_EQ(Antigrasp(rotation + "4 --threads 1").code, 0);
  ASSERT_EQ(Antigrasp(rotation + "5 --threads 3").code, 0);
  EXPECT_TRUE(FileContents(folder / "4") == FileContents(folder / "5"));
  EXPECT_EQ(Rows(folder / "4/history.csv").size(), 2u);  // the last row of each
}

TEST(PerturbCli, NamesTheObjectsThatCannotBePerturbedAndGoesOn) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/ball.stl", shapes::Sphere(1.0, 1));
  WriteMesh(folder / "in/open.ply", shapes::FlatSquare());
  const TriangleMesh cube = shapes::Cube();
  WriteMesh(folder / "in/two.obj", shapes::Joined(cube, Transformed(cube, 1.0, {5, 0, 0})));
  folder.Write("in/noise.off", "rubbish");
  const Outcome outcome =
      Antigrasp("perturb random " + dir + "in --iterations 50 --out " + dir + "out" + kQuick);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("1 of 4 objects perturbed"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("failed: 1 before: disjoint pieces, 1 before: not readable, 1 "
                              "before: open"),
            std::string::npos)
      << outcome.text;
  auto rows = Rows(folder / "out/perturb.csv");
  EXPECT_EQ(rows["two.obj"]["status"], "before: disjoint pieces: 2");
  EXPECT_EQ(rows["open.ply"]["graspability_after"], "");
  EXPECT_TRUE(fs::exists(folder / "out/after/ball.stl"));
  EXPECT_FALSE(fs::exists(folder / "out/after/two.stl"));
}

TEST(PerturbCli, SubdividesAFlatPartOrNamesItAndLeavesItOutOfTheMean) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box({20.0, 30.0, 50.0}));
  WriteMesh(folder / "ball.stl", shapes::Sphere(20.0, 3));
  const std::string search = "perturb search " + dir + "box.stl " + dir +
                             "ball.stl --alpha 20 --steps 60 --grasps 60 --num-grasps 50 "
                             "--num-draws 10 --out " +
                             dir;
  ASSERT_EQ(Antigrasp(search + "fine").code, 0);
  auto rows = Rows(folder / "fine/perturb.csv");
  EXPECT_EQ(rows["box.stl"]["status"], "ok");
  EXPECT_EQ(rows["box.stl"]["faces_before"], "12");
  EXPECT_GT(std::stol(rows["box.stl"]["faces_after"]), 1000);
  EXPECT_LT(std::stod(rows["box.stl"]["difference"]), 0.0);
  EXPECT_EQ(rows["ball.stl"]["faces_after"], "1280");  // fine enough as it is
  const TriangleMesh before = ReadMesh(folder / "fine/before/box.stl");
  EXPECT_NEAR(Volume(before), 30000.0, 1e-6);  // in the input's millimetres
  EXPECT_NEAR(Bounds(ReadMesh(folder / "fine/after/box.stl")).Extent().z(), 50.0, 2.0);

  // With many grasps to a score, so that no chance makes one of its eight corners worth moving.
  const Outcome outcome =
      Antigrasp("perturb search " + dir + "box.stl " + dir +
                "ball.stl --alpha 10 --steps 20 --subdivide 100 --out " + dir + "coarse");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  rows = Rows(folder / "coarse/perturb.csv");
  EXPECT_EQ(rows["box.stl"]["status"], "unchanged: too few vertices: 8");
  EXPECT_EQ(rows["box.stl"]["moved"], "0");
  EXPECT_FALSE(fs::exists(folder / "coarse/after/box.stl"));
  EXPECT_TRUE(fs::exists(folder / "coarse/before/box.stl"));
  EXPECT_NE(outcome.text.find("1 of 2 objects perturbed"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("failed: 1 unchanged"), std::string::npos) << outcome.text;
  ExpectRefused(search + "x --subdivide 0.1", "perturb.subdivide = 0.1");
}

TEST(PerturbCli, ResultsOfAnImportedSetAreInTheUnitOfItsMeshes) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box({20.0, 30.0, 50.0}));
  ASSERT_EQ(Antigrasp("dataset import " + dir + "box.stl --out " + dir + "box.h5").code, 0);
  ASSERT_EQ(
      Antigrasp("perturb random " + dir + "box.h5 --iterations 20 --out " + dir + "p" + kQuick)
          .code,
      0);
  for (const char* file : {"p/before/box.stl", "p/after/box.stl"}) {
    // To a third of a node, 50 / 28 mm.
    const Eigen::Vector3d extent = Bounds(ReadMesh(folder / file)).Extent();
    EXPECT_NEAR((extent - Eigen::Vector3d(20.0, 30.0, 50.0)).cwiseAbs().maxCoeff(), 0.0, 0.6);
  }
}

TEST(PerturbCli, RefusesBadInputInOneLineAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/ball.stl", shapes::Sphere(1.0, 1));
  folder.Write("file", "in the way");
  const std::string ball = dir + "in/ball.stl", out = " --out " + dir + "out";
  ExpectRefused("perturb", "subcommand");
  ExpectRefused("perturb random " + ball, "--out");
  ExpectRefused("perturb random " + dir + "none.stl" + out, "no such file");
  ExpectRefused("perturb random " + ball + out + " --alpha 90", "random.alpha = 90");
  ExpectRefused("perturb random " + ball + out + " --limit none", "one of original, step");
  ExpectRefused("perturb rotation " + ball + out + " --beta 0", "rotation.beta = 0");
  ExpectRefused("perturb exhaustive " + ball + out + " --cone 81", "perturb.cone = 81");
  fs::create_directory(folder / "before");
  fs::copy_file(folder / "in/ball.stl", folder / "before/ball.stl");
  ExpectRefused("perturb random " + dir + "before --out " + dir, "over the inputs");
  ExpectRefused("perturb random " + dir + "before/ball.stl --out " + dir, "over the inputs");
  ExpectRefused("perturb random " + ball + " --out " + dir + "file", "a folder");
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(PerturbCli, FillsTheFolderOfItsInputsWhereNothingMeetsThem) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", few = " --num-grasps 5 --num-draws 1 ";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/ball.stl", shapes::Sphere(1.0, 2));
  const std::string before = ReadFile(folder / "in/ball.stl");
  const std::string perturb = "perturb random " + dir + "in --iterations 5" + few + "--out ";
  const Outcome outcome = Antigrasp(perturb + dir + "in");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(ReadFile(folder / "in/ball.stl"), before);
  EXPECT_TRUE(fs::exists(folder / "in/after/ball.stl"));
  // The next call would read its own results and write over them.
  ExpectRefused(perturb + dir + "in --overwrite", "would be written over an object's file");
}

TEST(PerturbCli, SaysOnHowManyGraspsItsScoresAre) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 1.2, 2.0}));
  const std::string perturb = "perturb random " + dir + "box.stl --iterations 5 --num-draws 1 ";
  const Outcome outcome = Antigrasp(perturb + "--out " + dir + "p");
  EXPECT_NE(outcome.text.find("graspabilities on 100 grasps an object, of the meshes in before/ "
                              "and after/ (1 subdivided); evaluate takes 1000 of up to 100 "
                              "objects\n"),
            std::string::npos)
      << outcome.text;
  const Outcome many = Antigrasp(perturb + "--subdivide 100 --num-grasps 1000 --out " + dir + "q");
  EXPECT_NE(many.text.find("graspabilities on 1000 grasps an object, of the meshes in before/ and "
                           "after/\n"),
            std::string::npos)
      << many.text;
}

TEST(PerturbCli, KeepsTheObjectsThatAreDoneOnCtrlC) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 3));
  WriteMesh(folder / "none.stl", shapes::FlatSquare());
  Outcome outcome;
  for (const char* seconds : {"1", "4", "16", "64"}) {  // until it came as far as the work
    outcome = cli::Shell(std::string("timeout -s INT ") + seconds +
                         " " ANTIGRASP_BINARY " perturb random " + dir + "ball.stl " + dir +
                         "none.stl --iterations 1000000000 --out " + dir + "out");
    if (fs::exists(folder / "out/perturb.csv")) break;
  }
  EXPECT_NE(outcome.text.find("interrupted"), std::string::npos) << outcome.text;
  auto rows = Rows(folder / "out/perturb.csv");
  EXPECT_EQ(rows["ball.stl"]["status"], "interrupted");
  EXPECT_EQ(rows["ball.stl"]["graspability_before"], "");
  EXPECT_EQ(rows["none.stl"]["status"].substr(0, 12), "before: open");
  EXPECT_FALSE(fs::exists(folder / "out/after/ball.stl"));
}

TEST(PerturbCli, HelpNamesEveryMethodAndItsOptions) {
  const Outcome help = Antigrasp("help perturb");
  EXPECT_EQ(help.code, 0);
  for (const char* part : {"exhaustive", "random", "rotation", "search", "IV-B"}) {
    EXPECT_NE(help.text.find(part), std::string::npos) << part;
  }
  const Outcome own = Antigrasp("perturb random --help");
  EXPECT_EQ(own.code, 0);
  for (const char* flag : {"--alpha", "--limit", "--unchecked", "--friction", "--preset"}) {
    EXPECT_NE(own.text.find(flag), std::string::npos) << flag;
  }
}

}  // namespace
}  // namespace antigrasp
