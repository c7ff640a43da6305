// The commands of the paper's section VII: shape, poses, trial.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
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
using shapes::TempFolder;

bool Has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The fields of row `number` (0 = the header); without quotes and commas inside.
std::vector<std::string> Row(const fs::path& file, int number) {
  std::istringstream lines(ReadFile(file));
  std::string line, field;
  for (int i = 0; i <= number; ++i) std::getline(lines, line);
  std::vector<std::string> fields;
  for (std::istringstream row(line); std::getline(row, field, ',');) fields.push_back(field);
  return fields;
}

TEST(ShapeCli, WritesASolidInMillimetresWithItsCertificate) {
  const TempFolder folder;
  const std::string file = (folder / "cube.stl").string();
  const Outcome cube = Antigrasp("shape cube --phi 26 --size-mm 30 --out " + file);
  ASSERT_EQ(cube.code, 0) << cube.text;
  EXPECT_TRUE(Has(cube.text, "smallest antipodality angle  26.0000 degrees")) << cube.text;
  for (const char* claim : {"convex", "closed", "printable"}) {
    const std::string padded =
        std::string(claim) + std::string(29 - std::string(claim).size(), ' ');
    EXPECT_TRUE(Has(cube.text, padded + "yes\n")) << cube.text;
  }
  const TriangleMesh mesh = ReadMesh(file);
  EXPECT_TRUE(Inspect(mesh).IsSolid());
  EXPECT_NEAR(Bounds(mesh).Extent().x(), 30.0 * (1.0 + 0.5 * std::tan(26.0 * 0.017453292519943295)),
              1e-4);
}

TEST(ShapeCli, SearchesTheOthersTheSameWayForTheSameSeed) {
  const TempFolder folder;
  const auto make = [&](const std::string& name, const std::string& more) {
    const Outcome outcome = Antigrasp("shape octahedron --phi 15 --moves 10 --restarts 2 --out " +
                                      (folder / name).string() + more);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_TRUE(Has(outcome.text, "searching")) << outcome.text;
    return ReadFile(folder / name);
  };
  const std::string one = make("1.stl", " --threads 1");
  EXPECT_EQ(one, make("2.stl", " --threads 2"));
}

TEST(ShapeCli, SaysTheBestItReachedAndWritesNothing) {
  const TempFolder folder;
  const std::string out = " --out " + (folder / "x.stl").string();
  ExpectRefused("shape cube --phi 31" + out, "30.0000 degrees, the best reached");
  const Outcome far = Antigrasp("shape icosahedron --phi 70 --moves 1 --restarts 1" + out);
  EXPECT_EQ(far.code, 2);
  EXPECT_TRUE(Has(far.text, "out of reach (shape icosahedron)")) << far.text;
  ExpectRefused("shape cube --phi nan" + out, "70.5288");
  ExpectRefused("shape cube --phi 1 --size-mm nan" + out, "--size-mm");
  ExpectRefused("shape cube --phi 1 --out " + (folder / "x.txt").string(), "x.txt");
  ExpectRefused("shape octahedron --phi 1 --moves 0" + out, "shape.moves = 0");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ShapeCli, HelpExplainsTheCommandsOfSectionSeven) {
  const Outcome all = Antigrasp("help");
  for (const char* command : {"shape", "poses", "trial"}) {
    EXPECT_TRUE(Has(all.text, std::string("\n  ") + command + " ")) << all.text;
  }
  const Outcome trial = Antigrasp("help trial");
  EXPECT_EQ(trial.code, 0);
  EXPECT_TRUE(Has(trial.text, "--friction-angle")) << trial.text;
  EXPECT_TRUE(Has(trial.text, "--friction 0.5 Excludes: --friction-angle")) << trial.text;
}

TEST(PosesCli, ListsPosesOfEveryObjectAndMakesDoWithAnOpenMesh) {
  const TempFolder folder;
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/box.stl", shapes::Box({1, 2, 5}));
  TriangleMesh open = shapes::Box({1, 2, 5});
  open.faces.pop_back();
  WriteMesh(folder / "in/open.obj", open);
  WriteMesh(folder / "in/square.ply", shapes::FlatSquare());
  const Outcome outcome =
      Antigrasp("poses " + (folder / "in").string() + " --out " + (folder / "poses.csv").string());
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "box.stl: 6 stable poses")) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "centre of mass of its convex hull")) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "square.ply: no stable pose")) << outcome.text;
  const auto header = Row(folder / "poses.csv", 0);
  ASSERT_EQ(header.size(), 13u);
  EXPECT_EQ(header[2], "probability");
  const auto box = Row(folder / "poses.csv", 1), hull = Row(folder / "poses.csv", 7);
  EXPECT_EQ(box[0], "box.stl");
  EXPECT_EQ(hull[0], "open.obj");
  EXPECT_NEAR(std::stod(box[2]), std::stod(hull[2]), 1e-12);
  EXPECT_EQ(box[3], "0.5");
}

TEST(PosesCli, RefusesWhatHasNoPose) {
  const TempFolder folder;
  const std::string flat = (folder / "flat.stl").string();
  WriteMesh(flat, shapes::FlatSquare());
  const Outcome outcome = Antigrasp("poses " + flat + " --out " + (folder / "p.csv").string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(Has(outcome.text, "no stable pose")) << outcome.text;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(TrialCli, HoldsThePlainCubeAndNotTheOneBeyondTheCone) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "plain.stl", shapes::Box({30, 30, 30}));
  ASSERT_EQ(Antigrasp("shape cube --phi 26 --size-mm 30 --out " + dir + "spiky.stl").code, 0);
  const std::string command = "trial --engine model " + dir + "plain.stl " + dir +
                              "spiky.stl --mm --noise none --series 3 --num-grasps 20 "
                              "--num-draws 1 --min-epsilon 0 --out " +
                              dir;
  const Outcome outcome = Antigrasp(command + "t.csv --threads 1");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(Has(outcome.text, "full-cone")) << outcome.text;
  ASSERT_EQ(Antigrasp(command + "u.csv --threads 2").code, 0);
  EXPECT_EQ(ReadFile(folder / "t.csv"), ReadFile(folder / "u.csv"));
  const auto header = Row(folder / "t.csv", 0);
  ASSERT_EQ(header[11], "held");
  const auto plain = Row(folder / "t.csv", 2), spiky = Row(folder / "t.csv", 4);
  EXPECT_EQ(plain[1] + spiky[1], "full-conefull-cone");
  EXPECT_EQ(plain[11], "1");
  EXPECT_EQ(spiky[11], "0");
  EXPECT_EQ(spiky[5], "0");  // found
  const std::string constants = ReadFile(folder / "t.csv.trial.toml");
  EXPECT_TRUE(Has(constants, "friction_angle = 17")) << constants;
  EXPECT_TRUE(Has(constants, "approach_cone = 45")) << constants;
}

TEST(TrialCli, RefusesBadInputAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  WriteMesh(folder / "open.stl", shapes::FlatSquare());
  const std::string cube = "trial --engine model " + dir + "cube.stl --out " + dir + "t.csv";
  ExpectRefused(cube + " --friction 0.5", "--friction");
  ExpectRefused(cube + " --friction-angle nan", "--friction-angle");
  const Outcome open = Antigrasp("trial --engine model " + dir + "open.stl --out " + dir + "t.csv");
  EXPECT_EQ(open.code, 2);
  EXPECT_TRUE(Has(open.text, "expected a closed, oriented mesh")) << open.text;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

}  // namespace
}  // namespace antigrasp
