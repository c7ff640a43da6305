// One rule says what is usable: every command takes the same objects and gives the same reasons.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

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

// A mesh of every status that a file can have after repair.
const std::map<std::string, std::string> kRefused{
    {"corner.obj", "non-manifold: parts touch in a single vertex"},
    {"drilled.obj", "overlapping pieces: 2"},
    {"edge.obj", "non-manifold: 1 edge with more than two faces"},
    {"empty.obj", "empty: no faces"},
    {"flat.obj", "inside-out: volume not positive"},
    {"one_sided.obj", "not orientable: one-sided surface"},
    {"open.obj", "open: 4 boundary edges"},
    {"sliver.obj", "degenerate: 1 face without area"},
    {"spike.obj", "self-intersecting"},
    {"two.obj", "disjoint pieces: 2"}};

void FillFolder(const fs::path& folder) {
  fs::create_directory(folder);
  const TriangleMesh cube = shapes::Cube();
  WriteMesh(folder / "ball.obj", shapes::Sphere(1.0, 2));
  const TriangleMesh block = shapes::Box({4, 4, 4});
  WriteMesh(folder / "hollow.obj", shapes::Joined(block, shapes::Inverted(cube)));
  WriteMesh(folder / "united.obj", shapes::Joined(block, Transformed(cube, 1.0, {2, 0, 0})));
  WriteMesh(folder / "drilled.obj",
            shapes::Joined(block, shapes::Inverted(Transformed(cube, 1.0, {2, 0, 0}))));
  WriteMesh(folder / "open.obj", shapes::FlatSquare());
  TriangleMesh spike = shapes::Sphere(1.0, 2);
  spike.vertices[0] *= -3.0;
  WriteMesh(folder / "spike.obj", spike);
  WriteMesh(folder / "two.obj", shapes::Joined(cube, Transformed(cube, 1.0, {5, 0, 0})));
  WriteMesh(folder / "edge.obj", shapes::Joined(cube, Transformed(cube, 1.0, {1, 1, 0})));
  WriteMesh(folder / "corner.obj", shapes::Joined(cube, Transformed(cube, 1.0, {1, 1, 1})));
  TriangleMesh tetrahedron = shapes::Tetrahedron();
  tetrahedron.vertices[3] = {1, 1, 0};  // four corners in a plane
  WriteMesh(folder / "flat.obj", tetrahedron);
  tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 1}};  // three in a line
  WriteMesh(folder / "sliver.obj", tetrahedron);
  // The projective plane: half an icosahedron whose opposite corners are one.
  std::ofstream(folder / "one_sided.obj")
      << "v 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0.3 0\nv 0 -1 0.2\nv 0.5 0.5 -1\n"
         "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\nf 1 6 2\n"
         "f 2 3 5\nf 3 4 6\nf 4 5 2\nf 5 6 3\nf 6 2 4\n";
  std::ofstream(folder / "empty.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 3 3 1\n";
}

TEST(UsableCli, EveryCommandTakesTheSameObjectsAndGivesTheSameReasons) {
  const TempFolder folder;
  FillFolder(folder / "in");
  const std::string dir = folder.path().string() + "/", in = dir + "in";
  const std::string quick = " --num-grasps 5 --num-draws 5";
  ASSERT_EQ(Antigrasp("evaluate " + in + " --out " + dir + "s.csv" + quick).code, 0);
  std::map<std::string, std::string> evaluated, perturbed;
  for (auto& row : CsvRows(folder / "s.csv")) evaluated[row["object"]] = row["status"];
  ASSERT_EQ(Antigrasp("perturb random " + in + " --iterations 1 --out " + dir + "out" + quick).code,
            0);
  for (auto& row : CsvRows(folder / "out/perturb.csv")) perturbed[row["object"]] = row["status"];
  const Outcome exported = Antigrasp("export " + in + " --out " + dir + "print");
  ASSERT_EQ(
      Antigrasp("dataset import " + in + " --out " + dir + "x.h5 --report " + dir + "x.csv").code,
      0);
  std::map<std::string, std::string> imported;
  for (auto& row : CsvRows(folder / "x.csv")) {
    imported[fs::path(row["path"]).filename().string()] = row["status"] + " " + row["detail"];
  }
  const Outcome trial =
      Antigrasp("trial --engine model " + in +
                " --noise none --series 1 --grasps-per-series 1 --executions 1 --num-draws 1");
  const Outcome poses = Antigrasp("poses " + in);
  const Outcome compared = Antigrasp("compare " + in + " " + in + " --count 2");
  ASSERT_EQ(compared.code, 0) << compared.text;
  // The page is left out of builds without npm.
  const bool has_page = Antigrasp("help report").code == 0;
  const Outcome report = Antigrasp("report " + in + " --out " + dir + "page.html" + quick);
  ASSERT_TRUE(report.code == 0 || !has_page) << report.text;
  const std::string page = has_page ? ReadFile(folder / "page.html") : "";
  const std::string doc = ReadFile(fs::path(ANTIGRASP_CONFIGS) / "../docs/repair.md");
  for (const auto& [object, why] : kRefused) {
    EXPECT_EQ(evaluated[object], why);
    EXPECT_EQ(perturbed[object], "before: " + why);
    EXPECT_EQ(imported[object], "refused " + why);
    EXPECT_NE(exported.text.find(object + ": " + why), std::string::npos) << exported.text;
    EXPECT_NE(trial.text.find(object + ": left out: " + why), std::string::npos) << trial.text;
    EXPECT_NE(compared.text.find(", 1 " + why), std::string::npos) << compared.text;
    EXPECT_TRUE(!has_page || page.find('"' + why + '"') != std::string::npos) << why;
    EXPECT_TRUE(poses.text.find(object + ": " + why) != std::string::npos ||
                poses.text.find(object + ": no stable pose: " + why) != std::string::npos)
        << object << "\n"
        << poses.text;
    EXPECT_NE(doc.find("| `" + why.substr(0, why.find(':'))), std::string::npos) << why;
  }
  for (const std::string object : {"ball.obj", "hollow.obj", "united.obj"}) {
    EXPECT_TRUE(
        (std::set<std::string>{"ok", "few_grasps", "no_grasps"}).contains(evaluated[object]))
        << evaluated[object];
    EXPECT_EQ(perturbed[object], "ok");
    EXPECT_EQ(trial.text.find(object + ": left out"), std::string::npos) << trial.text;
    EXPECT_TRUE(fs::exists(folder / "print" / fs::path(object).replace_extension(".stl")));
  }
  EXPECT_EQ(imported["hollow.obj"], "accepted ");
  EXPECT_EQ(imported["united.obj"], "repaired united 2 overlapping pieces");
}

// A block of 4 x 4 x 10 with a closed void of 3 x 3 x 6 at z 3.5 ... 9.5: its centre of mass lies
// at (160 * 5 - 54 * 6.5) / 106.
TEST(UsableCli, PosesAndGraspsOfAHollowBlockHaveItsCentreOfMass) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", mesh = dir + "hollow.stl";
  const TriangleMesh block = Transformed(shapes::Box({4, 4, 10}), 1.0, {0, 0, 5});
  const TriangleMesh inner = Transformed(shapes::Box({3, 3, 6}), 1.0, {0, 0, 6.5});
  WriteMesh(mesh, shapes::Joined(block, shapes::Inverted(inner)));
  ASSERT_EQ(Antigrasp("poses " + mesh + " --out " + dir + "p.csv").code, 0);
  std::map<double, double> probability_at;
  for (auto& row : CsvRows(folder / "p.csv")) {
    probability_at[std::round(1e5 * std::stod(row["com_height"]))] = std::stod(row["probability"]);
  }
  ASSERT_EQ(probability_at.size(), 3u);
  EXPECT_NEAR(probability_at[423585], 0.058353, 1e-6);
  EXPECT_NEAR(probability_at[576415], 0.034270, 1e-6);
  EXPECT_NEAR(probability_at[200000], 0.226844, 1e-6);
  ASSERT_EQ(
      Antigrasp("evaluate " + mesh + " --num-grasps 5 --num-draws 5 --grasps " + dir + "g.csv")
          .code,
      0);
  for (auto& row : CsvRows(folder / "g.csv")) EXPECT_NEAR(std::stod(row["comz"]), 0.0423585, 1e-7);
}

}  // namespace
}  // namespace antigrasp
