// Folders that mix sizes: one factor for the set or one an object, and no file takes the others
// with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/datasets/imported.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

// Boxes of the given longest sides, half as wide: 0.obj, 1.obj, ...
void WriteBoxes(const TempFolder& folder, const std::vector<double>& sides) {
  for (std::size_t i = 0; i < sides.size(); ++i) {
    WriteMesh(folder / (std::to_string(i) + ".obj"),
              shapes::Box({sides[i], 0.5 * sides[i], 0.5 * sides[i]}));
  }
}

std::vector<std::string> Statuses(const Imported& imported) {
  std::vector<std::string> statuses;
  for (const ImportedMesh& report : imported.reports) statuses.push_back(report.status);
  return statuses;
}

// Nine objects of 10 cm and a table of 1.5 m: at the table's scale the others span 1.9 of 28 nodes.
TEST(ImportScale, ATableAmongObjectsForTheHandIsLeftOutByName) {
  const TempFolder folder;
  std::vector<double> sides(9, 0.1);
  sides.push_back(1.5);
  WriteBoxes(folder, sides);
  const Imported result = Import({folder.path()}, 32, 2);
  std::vector<std::string> expected(9, "accepted");
  expected.push_back("refused");
  EXPECT_EQ(Statuses(result), expected);
  EXPECT_EQ(result.reports[9].path, (folder / "9.obj").string());
  EXPECT_EQ(result.reports[9].detail,
            "too large for the set: 1.5 long, the median is 0.1 and at most 5 times that is taken; "
            "another unit? --scale each takes every size");
  EXPECT_EQ(result.set.grids.size(), 9U);
  EXPECT_NEAR(result.reports[0].nodes, 28.0, 1e-9);
}

TEST(ImportScale, ADamagedMeshAsLargeAsTheWorldTakesNothingWithIt) {
  const TempFolder folder;
  WriteBoxes(folder, {1.0, 1.5, 1e30, 0.8});
  const Imported result = Import({folder.path()}, 32, 1);
  EXPECT_EQ(Statuses(result),
            (std::vector<std::string>{"accepted", "accepted", "refused", "accepted"}));
  EXPECT_NE(result.reports[2].detail.find("1e+30 long, the median is 1 "), std::string::npos);
  EXPECT_NEAR(result.reports[1].nodes, 28.0, 1e-9);
}

TEST(ImportScale, OneInMillimetresAmongMetresIsLeftOutAndOneInMetresAmongMillimetresToo) {
  const TempFolder millimetres, metres;
  WriteBoxes(millimetres, {0.1, 0.12, 110.0, 0.09});
  EXPECT_EQ(Statuses(Import({millimetres.path()}, 32, 1)),
            (std::vector<std::string>{"accepted", "accepted", "refused", "accepted"}));
  WriteBoxes(metres, {100.0, 0.12, 110.0, 90.0});
  const Imported result = Import({metres.path()}, 32, 1);
  EXPECT_EQ(Statuses(result),
            (std::vector<std::string>{"accepted", "refused", "accepted", "accepted"}));
  EXPECT_EQ(result.reports[1].detail.substr(0, 21), "too thin for the grid");
  EXPECT_NEAR(result.reports[1].nodes, 28.0 * 0.12 / 110.0, 1e-9);
}

// Lower median 1: 5 is taken, and a hair more is not.
TEST(ImportScale, FiveTimesTheMedianIsTheMost) {
  const TempFolder folder, more;
  WriteBoxes(folder, {1.0, 5.0});
  EXPECT_EQ(Statuses(Import({folder.path()}, 32, 1)),
            (std::vector<std::string>{"accepted", "accepted"}));
  WriteBoxes(more, {1.0, 5.001});
  EXPECT_EQ(Statuses(Import({more.path()}, 32, 1)),
            (std::vector<std::string>{"accepted", "refused"}));
}

TEST(ImportScale, EachObjectFillsTheGridWhateverItsSize) {
  const TempFolder folder;
  WriteBoxes(folder, {0.1, 110.0, 1e30});
  const Imported result = Import({folder.path()}, 32, 2, ImportScale::kEach);
  EXPECT_EQ(Statuses(result), (std::vector<std::string>(3, "accepted")));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(result.reports[i].nodes, 28.0, 1e-9);
    // 28 nodes by 14 by 14 are inside.
    const std::vector<float>& values = result.set.grids[i].values;
    EXPECT_EQ(std::count_if(values.begin(), values.end(), [](float v) { return v > 0.0F; }),
              28 * 14 * 14);
  }
  EXPECT_EQ(result.set.provenance,
            "imported from " + folder.path().string() + ", each scaled to the cube");
}

TEST(ImportScale, NothingIsLeftBesideTheSetAlsoWhenTheImportFails) {
  const TempFolder folder, out;
  WriteBoxes(folder, {1.0, 2.0});
  ImportMeshes({folder.path()}, out / "set.h5", {32, ImportScale::kSet, 1});
  const auto files = [&] {
    return std::distance(std::filesystem::directory_iterator(out.path()), {});
  };
  EXPECT_EQ(files(), 1);
  const auto stop = [](std::int64_t done, std::int64_t) {
    if (done == 3) throw Interrupted();
  };
  EXPECT_THROW(ImportMeshes({folder.path()}, out / "other.h5", {32, ImportScale::kSet, 1}, stop),
               Interrupted);
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace antigrasp
