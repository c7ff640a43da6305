#include "antigrasp/datasets/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/datasets/imported.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

std::string WhatIsThrown(const std::vector<std::filesystem::path>& inputs) {
  try {
    Import(inputs, 16, 1);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing thrown";
}

// Extent along x of the part that is inside, to the nearest node.
double InsideExtent(const SdfGrid& grid) {
  int low = grid.n, high = -1;
  for (int z = 0; z < grid.n; ++z) {
    for (int y = 0; y < grid.n; ++y) {
      for (int x = 0; x < grid.n; ++x) {
        if (grid.values[grid.Index(x, y, z)] <= 0.0f) continue;
        low = std::min(low, x);
        high = std::max(high, x);
      }
    }
  }
  return (high - low + 1) * grid.spacing;
}

// One file of every kind that people have.
void FillWithMixture(const TempFolder& folder) {
  std::filesystem::create_directories(folder / "b/deep");
  WriteMesh(folder / "b/deep/sphere.stl", shapes::Sphere(2.0, 3));
  WriteMesh(folder / "a-torus.obj", shapes::Torus(1.0, 0.4, 24, 12));
  WriteMesh(folder / "b/inverted.ply", shapes::Inverted(shapes::Sphere(1.0, 2)));
  TriangleMesh open = shapes::Sphere(1.0, 2);
  open.faces.resize(open.faces.size() - 1);
  WriteMesh(folder / "open.off", open);
  folder.Write("garbage.stl", "this is not a mesh");
  folder.Write("empty.ply", "");
  folder.Write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  TriangleMesh spike = shapes::Sphere(1.0, 2);
  spike.vertices[0] *= -3.0;
  WriteMesh(folder / "spike.ply", spike);
  WriteMesh(folder / "apart.STL",
            shapes::Joined(shapes::Cube(), Transformed(shapes::Cube(), 1.0, {50, 0, 0})));
  WriteMesh(folder / "needle.obj", shapes::Box({3.0, 0.001, 0.001}));
  folder.Write("readme.txt", "no mesh");
}

TEST(ImportMeshes, AMixtureIsSortedIntoAcceptedRepairedAndRefused) {
  const TempFolder folder;
  FillWithMixture(folder);
  const Imported result = Import({folder.path()}, 32, 2);

  std::map<std::string, std::pair<std::string, std::string>> reports;
  for (const ImportedMesh& report : result.reports) {
    reports[std::filesystem::path(report.path).filename().string()] = {report.status,
                                                                       report.detail};
  }
  ASSERT_EQ(result.reports.size(), 10u);
  EXPECT_EQ(reports["sphere.stl"], std::pair(std::string("accepted"), std::string()));
  EXPECT_EQ(reports["a-torus.obj"], std::pair(std::string("accepted"), std::string()));
  EXPECT_EQ(reports["inverted.ply"],
            std::pair(std::string("repaired"), std::string("turned inside out")));
  const std::map<std::string, std::string> refusals{
      {"open.off", "open: 3 boundary edges"},    {"garbage.stl", "not readable: "},
      {"empty.ply", "not readable: empty file"}, {"nan.obj", "not readable: vertex 1 = nan"},
      {"spike.ply", "self-intersecting"},        {"apart.STL", "disjoint pieces: 2"},
      {"needle.obj", "too thin for the grid"}};
  for (const auto& [name, detail] : refusals) {
    EXPECT_EQ(reports[name].first, "refused") << name;
    EXPECT_TRUE(reports[name].second.starts_with(detail)) << name << ": " << reports[name].second;
  }
  EXPECT_EQ(result.set.kind, "import");
  EXPECT_EQ(result.set.truncation, 0.0);
  EXPECT_EQ(result.set.names,
            (std::vector<std::string>{"a-torus.obj", "b/deep/sphere.stl", "b/inverted.ply"}));
  EXPECT_EQ(result.set.grids.size(), 3u);
  EXPECT_TRUE(std::is_sorted(result.reports.begin(), result.reports.end(),
                             [](const auto& a, const auto& b) {
                               return std::filesystem::path(a.path) < std::filesystem::path(b.path);
                             }));
}

TEST(ImportMeshes, AVoidIsOutsideAndNoSecondPiece) {
  const TempFolder folder;
  // A cube of 28 cells with a void of 10 in its middle.
  WriteMesh(folder / "hollow.obj",
            shapes::Joined(shapes::Box({28, 28, 28}), shapes::Inverted(shapes::Box({10, 10, 10}))));
  const Imported result = Import({folder.path()}, 32, 1);
  ASSERT_EQ(result.reports.size(), 1u);
  EXPECT_EQ(result.reports[0].status, "accepted");
  const SdfGrid& grid = result.set.grids[0];
  EXPECT_NEAR(grid.values[grid.Index(16, 16, 16)], -4.5 / 32.0, 1e-6);
  EXPECT_EQ(std::count_if(grid.values.begin(), grid.values.end(), [](float v) { return v > 0.0F; }),
            28 * 28 * 28 - 10 * 10 * 10);
}

TEST(ImportMeshes, OneScaleForTheSetLeavesTwoCellsOnEverySide) {
  const TempFolder folder;
  // Off centre, and of sizes 7 : 2. The larger one becomes 28/32 of the unit cube wide.
  WriteMesh(folder / "large.obj", Transformed(shapes::Cube(), 7.0, {100.0, -7.0, 3.0}));
  WriteMesh(folder / "small.obj", Transformed(shapes::Cube(), 2.0, {-5.0, 0.0, 0.0}));
  const Imported result = Import({folder.path()}, 32, 1);
  ASSERT_EQ(result.set.grids.size(), 2u);
  const SdfGrid& large = result.set.grids[0];
  EXPECT_DOUBLE_EQ(InsideExtent(large), 28.0 / 32.0);
  EXPECT_DOUBLE_EQ(InsideExtent(result.set.grids[1]), 8.0 / 32.0);
  // The node nearest to the middle is half a cell from it along each axis: distance to the faces.
  EXPECT_NEAR(large.values[large.Index(16, 16, 16)], 14.0 / 32.0 - 0.5 / 32.0, 1e-6);
  EXPECT_NEAR(large.values[large.Index(0, 16, 16)], -1.5 / 32.0, 1e-6);
}

TEST(ImportMeshes, OneFactorIsKeptInTheFileAsTheSideOfTheCubeInTheMeshesUnit) {
  const TempFolder folder;
  // 70 long: 28 of 32 nodes, so that the cube is 80 wide.
  const auto path = folder / "box.stl";
  WriteMesh(path, shapes::Box({20.0, 40.0, 70.0}));
  ImportOptions options{.resolution = 32, .threads = 1};
  ImportMeshes({path}, folder / "set.h5", options);
  EXPECT_NEAR(ReadShapeSetInfo(folder / "set.h5").side, 80.0, 1e-12);
  const ShapeSet set = ReadShapeSet(folder / "set.h5");
  EXPECT_NEAR(set.side, 80.0, 1e-12);
  WriteShapeSet(folder / "again.h5", set);
  EXPECT_EQ(ReadFile(folder / "again.h5"), ReadFile(folder / "set.h5"));
  const auto longest = [&](const char* file, GridUnit unit) {
    const ObjectSource source({(folder / file).string()}, unit);
    return Bounds(source.Load(0).mesh).Extent().maxCoeff();
  };
  const double in_cube = longest("set.h5", GridUnit::kCube);
  EXPECT_NEAR(in_cube, 28.0 / 32.0, 0.5 / 32.0);
  EXPECT_NEAR(longest("set.h5", GridUnit::kOfFiles), 80.0 * in_cube, 1e-9);
  options.scale = ImportScale::kEach;  // one side for each: none for the set
  ImportMeshes({path}, folder / "each.h5", options);
  EXPECT_EQ(ReadShapeSetInfo(folder / "each.h5").side, 0.0);
  EXPECT_EQ(longest("each.h5", GridUnit::kOfFiles), longest("each.h5", GridUnit::kCube));
  EXPECT_THROW(ImportMeshes({path}, folder / "set.obj", options), InputError);  // a mesh's name
  EXPECT_FALSE(std::filesystem::exists(folder / "set.obj"));
}

TEST(ImportMeshes, DistancesOfASphereAreExactUpToItsFacets) {
  const TempFolder folder;
  WriteMesh(folder / "sphere.ply", shapes::Sphere(3.0, 5));
  const SdfGrid grid = Import({folder / "sphere.ply"}, 16, 1).set.grids.at(0);
  const double radius = 0.5 * 12.0 / 16.0;
  for (int z = 0; z < 16; ++z) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_NEAR(grid.values[grid.Index(x, 5, z)], radius - grid.Node(x, 5, z).norm(), 1e-3);
    }
  }
}

TEST(ImportMeshes, TheSetDependsNeitherOnThreadsNorOnTheOrderOfInputs) {
  const TempFolder folder;
  FillWithMixture(folder);
  const Imported one = Import({folder.path()}, 16, 1);
  const Imported four = Import({folder / "b", folder.path()}, 16, 4);
  ASSERT_EQ(one.set.grids.size(), four.set.grids.size());
  for (std::size_t i = 0; i < one.set.grids.size(); ++i) {
    EXPECT_EQ(one.set.grids[i].values, four.set.grids[i].values);
  }
  ASSERT_EQ(one.reports.size(), four.reports.size());  // every file once
  for (std::size_t i = 0; i < one.reports.size(); ++i) {
    EXPECT_EQ(one.reports[i].path, four.reports[i].path);
  }
}

TEST(ImportMeshes, EqualNamesInTwoFoldersStayApart) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "a");
  std::filesystem::create_directories(folder / "b");
  WriteMesh(folder / "a/cube.stl", shapes::Cube());
  WriteMesh(folder / "b/cube.stl", shapes::Cube());
  const auto names = Import({folder / "a", folder / "b"}, 16, 1).set.names;
  EXPECT_EQ(names, (std::vector<std::string>{"a/cube.stl", "b/cube.stl"}));
}

TEST(ImportMeshes, ProgressCountsUpToTheEndAndMayInterrupt) {
  const TempFolder folder;
  FillWithMixture(folder);
  std::int64_t last = 0, total = 0;
  Import({folder.path()}, 16, 2, ImportScale::kSet, [&](std::int64_t done, std::int64_t all) {
    EXPECT_EQ(done, last + 1);
    last = done;
    total = all;
  });
  EXPECT_GT(total, 0);
  EXPECT_EQ(last, total);
  EXPECT_THROW(Import({folder.path()}, 16, 2, ImportScale::kSet,
                      [](std::int64_t, std::int64_t) { throw Interrupted(); }),
               Interrupted);
}

TEST(ImportMeshes, InputsWithoutAUsableMeshAreErrorsThatSayWhy) {
  const TempFolder folder;
  EXPECT_NE(WhatIsThrown({folder / "missing"}).find("no such file or folder"), std::string::npos);
  EXPECT_NE(WhatIsThrown({folder.path()}).find("no mesh file"), std::string::npos);
  EXPECT_NE(WhatIsThrown({}).find("no mesh file"), std::string::npos);
  WriteMesh(folder / "square.stl", shapes::FlatSquare());
  const std::string message = WhatIsThrown({folder.path()});
  EXPECT_NE(message.find("open: 4 boundary edges"), std::string::npos) << message;
  EXPECT_NE(message.find("square.stl"), std::string::npos) << message;
  const auto text = folder.Write("notes.txt", "x");
  EXPECT_NE(WhatIsThrown({text}).find("'.txt'"), std::string::npos);
  EXPECT_THROW(Import({folder.path()}, 4, 1), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
