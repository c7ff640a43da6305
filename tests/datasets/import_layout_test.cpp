// Where imported meshes lie on their grids: one scale, own centres, axes, order and names, with
// meshes that differ along every axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/datasets/imported.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

// First and last inside node along x, y, z.
std::array<int, 6> InsideNodes(const SdfGrid& grid) {
  std::array<int, 6> range = {grid.n, -1, grid.n, -1, grid.n, -1};
  for (int z = 0; z < grid.n; ++z) {
    for (int y = 0; y < grid.n; ++y) {
      for (int x = 0; x < grid.n; ++x) {
        if (grid.values[grid.Index(x, y, z)] <= 0.0F) continue;
        const std::array<int, 3> node = {x, y, z};
        for (std::size_t k = 0; k < 3; ++k) {
          range[2 * k] = std::min(range[2 * k], node[k]);
          range[2 * k + 1] = std::max(range[2 * k + 1], node[k]);
        }
      }
    }
  }
  return range;
}

TEST(ImportMeshes, TheLongestSideOfAllSetsTheScaleAndAxesStay) {
  const TempFolder folder;
  // 12 of 16 cells for the longest side, 24: half a cell for a unit.
  WriteMesh(folder / "a.obj", Transformed(shapes::Box({4, 12, 24}), 1.0, {100, -7, 3}));
  WriteMesh(folder / "b.obj", Transformed(shapes::Box({20, 8, 4}), 1.0, {0, 50, 0}));
  const Imported result = Import({folder.path()}, 16, 1);
  ASSERT_EQ(result.set.grids.size(), 2U);
  EXPECT_EQ(InsideNodes(result.set.grids[0]), (std::array<int, 6>{7, 8, 5, 10, 2, 13}));
  EXPECT_EQ(InsideNodes(result.set.grids[1]), (std::array<int, 6>{3, 12, 6, 9, 7, 8}));
  // Half a cell of 1/16 inside the sides across x.
  const SdfGrid& grid = result.set.grids[0];
  EXPECT_NEAR(grid.values[grid.Index(7, 7, 7)], 0.5 / 16, 1e-7);
  EXPECT_EQ(result.set.provenance,
            "imported from " + folder.path().string() + ", scaled by 0.03125");
  EXPECT_EQ(result.set.seed, 0U);
}

// A corner of three equal sides: its mass lies near the corner, its box is centred.
TEST(ImportMeshes, CentresTheBoundingBox) {
  const TempFolder folder;
  WriteMesh(folder / "corner.obj", shapes::Tetrahedron());
  const SdfGrid grid = Import({folder.path()}, 16, 1).set.grids.at(0);
  // The faces x = 0, y = 0, z = 0 lie six cells from the middle; the slope cuts the box.
  for (const auto index : {grid.Index(2, 3, 4), grid.Index(4, 2, 3), grid.Index(3, 4, 2)}) {
    EXPECT_NEAR(grid.values[index], 0.5 / 16, 1e-7);
  }
  EXPECT_LT(grid.values[grid.Index(12, 12, 12)], 0.0F);
}

TEST(ImportMeshes, ARefusedMeshDoesNotSetTheScale) {
  const TempFolder folder;
  WriteMesh(folder / "a.obj", shapes::Cube());
  TriangleMesh open = shapes::Box({50, 50, 50});
  open.faces.pop_back();
  WriteMesh(folder / "b.obj", open);
  const Imported result = Import({folder.path()}, 16, 1);
  ASSERT_EQ(result.set.grids.size(), 1U);
  EXPECT_EQ(InsideNodes(result.set.grids[0]), (std::array<int, 6>{2, 13, 2, 13, 2, 13}));
  EXPECT_EQ(result.reports.at(1).status, "refused");
  EXPECT_EQ(result.reports.at(1).detail.substr(0, 5), "open:");
}

TEST(ImportMeshes, AMeshTooThinForTheGridIsReportedInFull) {
  const TempFolder folder;
  WriteMesh(folder / "cube.obj", shapes::Cube());
  WriteMesh(folder / "needle.obj", shapes::Box({0.01, 0.01, 2}));
  const Imported result = Import({folder.path()}, 16, 1);
  ASSERT_EQ(result.reports.size(), 2U);
  EXPECT_EQ(result.reports[0].path, (folder / "cube.obj").string());
  EXPECT_EQ(result.reports[0].status, "accepted");
  EXPECT_EQ(result.reports[0].detail, "");
  EXPECT_EQ(result.reports[1].path, (folder / "needle.obj").string());
  EXPECT_EQ(result.reports[1].status, "refused");
  EXPECT_EQ(result.reports[1].detail,
            "too thin for the grid: no node of 16^3 is inside, at the scale of the whole set");
  // It was usable when the scale was set: 6 cells for the cube.
  ASSERT_EQ(result.set.grids.size(), 1U);
  EXPECT_EQ(InsideNodes(result.set.grids[0]), (std::array<int, 6>{5, 10, 5, 10, 5, 10}));
}

TEST(ImportMeshes, SortsByPathAndNamesFromTheFolderThatWasGiven) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "a/deep");
  std::filesystem::create_directories(folder / "b");
  WriteMesh(folder / "a/z.obj", shapes::Box({12, 4, 4}));
  WriteMesh(folder / "a/deep/y.obj", shapes::Box({4, 12, 4}));
  WriteMesh(folder / "b/c.obj", shapes::Box({4, 4, 12}));
  const Imported result = Import({folder / "b/c.obj", folder / "a"}, 16, 2);
  EXPECT_EQ(result.set.names, (std::vector<std::string>{"deep/y.obj", "z.obj", "c.obj"}));
  ASSERT_EQ(result.reports.size(), 3U);
  EXPECT_EQ(result.reports[0].path, (folder / "a/deep/y.obj").string());
  EXPECT_EQ(result.reports[2].path, (folder / "b/c.obj").string());
  EXPECT_EQ(InsideNodes(result.set.grids.at(0)), (std::array<int, 6>{6, 9, 2, 13, 6, 9}));
  EXPECT_EQ(InsideNodes(result.set.grids.at(1)), (std::array<int, 6>{2, 13, 6, 9, 6, 9}));
  EXPECT_EQ(InsideNodes(result.set.grids.at(2)), (std::array<int, 6>{6, 9, 6, 9, 2, 13}));
  EXPECT_EQ(result.set.provenance, "imported from " + (folder / "b/c.obj").string() + ", " +
                                       (folder / "a").string() + ", scaled by 0.0625");
}

TEST(ImportMeshes, TakesAFileOfTwoNamesOnce) {
  const TempFolder folder;
  WriteMesh(folder / "a.obj", shapes::Cube());
  std::filesystem::create_symlink(folder / "a.obj", folder / "b.obj");
  const Imported result = Import({folder.path(), folder / "a.obj"}, 16, 1);
  EXPECT_EQ(result.set.names, std::vector<std::string>{"a.obj"});
  EXPECT_EQ(result.reports.size(), 1U);
}

TEST(ImportMeshes, CountsReadingAndGriddingAsAStepEach) {
  const TempFolder folder;
  for (const char* name : {"a.obj", "b.obj", "c.obj"}) WriteMesh(folder / name, shapes::Cube());
  std::vector<std::int64_t> steps, totals;
  Import({folder.path()}, 16, 1, ImportScale::kSet, [&](std::int64_t done, std::int64_t total) {
    steps.push_back(done);
    totals.push_back(total);
  });
  EXPECT_EQ(steps, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(totals, std::vector<std::int64_t>(6, 6));
}

}  // namespace
}  // namespace antigrasp
