// Objects that share a file name: every command gives each a row and a file of its own, and
// nobody's file is written over.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/shape_set.h"
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
using Names = std::vector<std::string>;

const Names kYcbNames = {"001_brick/google_16k/nontextured.stl",
                         "002_cube/google_16k/nontextured.stl",
                         "003_rod/google_16k/nontextured.stl"};

// Three bodies as YCB lays them out; the arguments that name them.
std::string WriteYcb(const TempFolder& folder) {
  std::string arguments;
  const std::vector<Eigen::Vector3d> sizes = {{0.2, 0.1, 0.05}, {0.1, 0.1, 0.1}, {0.3, 0.1, 0.1}};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const fs::path path = folder / ("ycb/" + kYcbNames[i]);
    fs::create_directories(path.parent_path());
    WriteMesh(path, shapes::Box(sizes[i]));
    arguments += path.string() + " ";
  }
  return arguments;
}

Names ObjectsOf(const fs::path& table) {
  Names names;
  for (auto& row : CsvRows(table)) names.push_back(row.at("object"));
  return names;
}

std::set<std::string> FilesIn(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files.insert(entry.path().filename().string());
  }
  return files;
}

TEST(NamesCli, ObjectsOfOneFileNameAreToldApartInEveryTableAndFile) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", ycb = WriteYcb(folder);
  const Outcome exported = Antigrasp("export " + ycb + "--out " + dir + "out");
  ASSERT_EQ(exported.code, 0) << exported.text;
  EXPECT_EQ(FilesIn(folder / "out"),
            (std::set<std::string>{"001_brick_google_16k_nontextured.stl",
                                   "002_cube_google_16k_nontextured.stl",
                                   "003_rod_google_16k_nontextured.stl", "print.csv"}));
  EXPECT_EQ(ObjectsOf(folder / "out/print.csv"), kYcbNames);
  const auto brick = Bounds(ReadMesh(folder / "out/001_brick_google_16k_nontextured.stl"));
  EXPECT_NEAR(brick.Extent().y(), 30.0, 1e-4);  // half of 60 mm

  ASSERT_EQ(Antigrasp("evaluate " + ycb + "--out " + dir + "s.csv --grasps " + dir + "g.csv").code,
            0);
  EXPECT_EQ(ObjectsOf(folder / "s.csv"), kYcbNames);
  const Names of_grasps = ObjectsOf(folder / "g.csv");
  EXPECT_EQ(std::set<std::string>(of_grasps.begin(), of_grasps.end()),
            std::set<std::string>(kYcbNames.begin(), kYcbNames.end()));

  ASSERT_EQ(Antigrasp("poses " + ycb + "--out " + dir + "poses.csv").code, 0);
  EXPECT_EQ(ObjectsOf(folder / "poses.csv").back(), kYcbNames.back());

  const Outcome imported = Antigrasp("dataset import " + ycb + "--out " + dir + "set.h5");
  ASSERT_EQ(imported.code, 0) << imported.text;
  EXPECT_EQ(ReadShapeNames(folder / "set.h5"), kYcbNames);

  // The same files in a folder have the same names.
  ASSERT_EQ(Antigrasp("evaluate " + dir + "ycb --out " + dir + "folder.csv").code, 0);
  EXPECT_EQ(ObjectsOf(folder / "folder.csv"), kYcbNames);
}

TEST(NamesCli, OneNameInTwoFormatsGivesTwoFiles) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "pair");
  WriteMesh(folder / "pair/mug.stl", shapes::Sphere(1.0, 2));
  WriteMesh(folder / "pair/mug.obj", shapes::Box({1, 1, 2}));
  const Outcome exported = Antigrasp("export " + dir + "pair --size-mm 60 --out " + dir + "out");
  ASSERT_EQ(exported.code, 0) << exported.text;
  EXPECT_EQ(FilesIn(folder / "out"),
            (std::set<std::string>{"mug_obj.stl", "mug_stl.stl", "print.csv"}));
  EXPECT_NEAR(Bounds(ReadMesh(folder / "out/mug_obj.stl")).Extent().x(), 30.0, 1e-4);
  EXPECT_NEAR(Bounds(ReadMesh(folder / "out/mug_stl.stl")).Extent().x(), 60.0, 1.0);
  const Outcome perturbed =
      Antigrasp("perturb random " + dir + "pair --iterations 5 --out " + dir + "p");
  ASSERT_EQ(perturbed.code, 0) << perturbed.text;
  EXPECT_EQ(FilesIn(folder / "p/after"), (std::set<std::string>{"mug_obj.stl", "mug_stl.stl"}));
  EXPECT_EQ(ObjectsOf(folder / "p/perturb.csv"), (Names{"mug_obj", "mug_stl"}));
}

TEST(NamesCli, GridsOfOneNameGiveAMeshEach) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make prisms --count 3 --out " + dir + "a.h5").code, 0);
  ShapeSet set = ReadShapeSet(folder / "a.h5");
  set.names = {"same", "same", "same.obj"};
  WriteShapeSet(folder / "b.h5", set);
  ASSERT_EQ(Antigrasp("remesh " + dir + "b.h5 --out " + dir + "m").code, 0);
  EXPECT_EQ(FilesIn(folder / "m").size(), 4U);
  // Two files with the same names, as samples of two checkpoints have.
  fs::copy_file(folder / "a.h5", folder / "c.h5");
  ASSERT_EQ(Antigrasp("evaluate " + dir + "a.h5 " + dir + "c.h5 --out " + dir + "s.csv").code, 0);
  EXPECT_EQ(ObjectsOf(folder / "s.csv"),
            (Names{"a/prisms-000000", "a/prisms-000001", "a/prisms-000002", "c/prisms-000000",
                   "c/prisms-000001", "c/prisms-000002"}));
}

TEST(NamesCli, NoFileOfAnObjectIsWrittenOver) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 1));
  const std::string before = ReadFile(folder / "ball.stl"), ball = dir + "ball.stl";
  ExpectRefused("export " + ball + " --out " + dir, "over an object's file");
  ExpectRefused("evaluate " + ball + " --out " + ball, "over an object's file");
  ExpectRefused("evaluate " + ball + " --out " + dir + "s.csv --grasps " + dir + "s.csv",
                "two files would be written as one");
  ExpectRefused("poses " + ball + " --out " + ball, "over an object's file");
  ExpectRefused("trial --engine model " + ball + " --out " + ball, "over an object's file");
  ExpectRefused("dataset import " + ball + " --out " + ball, "over a mesh to import");
  ExpectRefused("dataset import " + ball + " --out " + dir + "x.h5 --report " + ball,
                "over an object's file");
  std::filesystem::create_directory(folder / "other");
  WriteMesh(folder / "other/ball.stl", shapes::Cube());
  const std::string original = dir + "other/ball.stl", cube = ReadFile(original);
  ExpectRefused("evaluate " + ball + " --baseline " + original + " --out " + original,
                "over an object's file");
  ExpectRefused("compare " + dir + "other " + ball + " --out " + original, "over an object's file");
  ExpectRefused("sheet " + ball + " --out " + ball, "over an object's file");
  EXPECT_EQ(ReadFile(original), cube);
  std::filesystem::remove_all(folder / "other");
  ExpectRefused("dataset import " + ball + " --out " + dir + "x.h5 --report " + dir + "x.h5",
                "two files would be written as one");
  EXPECT_EQ(ReadFile(folder / "ball.stl"), before);
  EXPECT_EQ(FilesIn(folder.path()), std::set<std::string>{"ball.stl"});
}

TEST(NamesCli, AFileThatCannotBeReadLeavesNothingBehind) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 1));
  folder.Write("broken.stl", "no mesh");
  const std::string both = dir + "ball.stl " + dir + "broken.stl";
  ExpectRefused("export " + both + " --out " + dir + "out", "broken.stl");
  ExpectRefused("evaluate " + both + " --out " + dir + "s.csv --grasps " + dir + "g.csv",
                "broken.stl");
  EXPECT_EQ(FilesIn(folder.path()), (std::set<std::string>{"ball.stl", "broken.stl"}));
}

}  // namespace
}  // namespace antigrasp
