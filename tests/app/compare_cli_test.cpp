// The command compare: what it prints and writes, limits and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/datasets/surface_comparison.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/repair.h"
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

struct Pair {
  std::string samples, reference;
};

std::map<std::string, Pair> Measures(const fs::path& path) {
  CsvReader reader(path);
  EXPECT_EQ(reader.names(), (std::vector<std::string>{"measure", "samples", "reference"}));
  std::map<std::string, Pair> measures;
  while (reader.Next()) measures[reader.Field(0)] = {reader.Field(1), reader.Field(2)};
  return measures;
}

// Folders a (samples), b (reference) of boxes; a also holds what is no solid.
void WriteSets(const TempFolder& folder) {
  for (const char* name : {"a", "b"}) fs::create_directory(folder / name);
  for (int i = 0; i < 6; ++i) {
    const std::string name = std::to_string(i) + ".stl";
    WriteMesh(folder / "a" / name, shapes::Box({1.0, 1.0 + 0.2 * i, 2.0}));
    WriteMesh(folder / "b" / name, shapes::Box({1.0, 1.1 + 0.2 * i, 2.0}));
  }
  WriteMesh(folder / "a" / "open.stl", shapes::FlatSquare());
  folder.Write("a/broken.stl", "no mesh");
}

TEST(CompareCli, PrintsATableAndWritesTheSameNumbersAtAnyThreadCount) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteSets(folder);
  const std::string sets = "compare " + dir + "a " + dir + "b --train " + dir + "b --points 200";
  const Outcome one = Antigrasp(sets + " --threads 1 --out " + dir + "one.csv");
  ASSERT_EQ(one.code, 0) << one.text;
  EXPECT_NE(one.text.find("coverage (COV), %"), std::string::npos) << one.text;
  EXPECT_NE(one.text.find("8 objects: 6 ok"), std::string::npos) << one.text;
  ASSERT_EQ(Antigrasp(sets + " --threads 4 --out " + dir + "four.csv").code, 0);
  EXPECT_EQ(ReadFile(folder / "one.csv"), ReadFile(folder / "four.csv"));

  auto measures = Measures(folder / "one.csv");
  EXPECT_EQ(measures["shapes"].samples, "6");
  EXPECT_EQ(measures["left_out"].samples, "2");
  EXPECT_EQ(measures["left_out"].reference, "0");
  EXPECT_EQ(measures["coverage"].reference, "");
  EXPECT_NEAR(std::stod(measures["size"].reference) - std::stod(measures["size"].samples), 0.06,
              0.02);
  EXPECT_FALSE(measures["nearer_to_training"].samples.empty());
}

// Boxes of these heights as meshes and as files.
std::vector<TriangleMesh> WriteBoxes(const fs::path& folder, const std::vector<double>& heights) {
  fs::create_directory(folder);
  std::vector<TriangleMesh> boxes;
  for (const double height : heights) {
    const fs::path path = folder / (std::to_string(boxes.size()) + ".stl");
    WriteMesh(path, shapes::Box({1.0, 1.0, height}));
    boxes.push_back(Repair(ReadMesh(path)).mesh);
  }
  return boxes;
}

TEST(CompareCli, WritesEveryMeasureOfEitherSetUnderItsOwnName) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  // The samples are near-copies of each other, the reference is spread out, and the training set
  // is nearer to the samples.
  const auto a = WriteBoxes(folder / "a", {1.0, 1.01, 1.5}),
             b = WriteBoxes(folder / "b", {1.0, 2.0, 4.0}), t = WriteBoxes(folder / "t", {1.4});
  folder.Write("b/broken.stl", "no mesh");
  const Outcome outcome = Antigrasp("compare " + dir + "a " + dir + "b --train " + dir +
                                    "t --points 300 --seed 5 --out " + dir + "c.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const auto streams = [](std::size_t count) {  // of "0.stl", "1.stl", ...
    std::vector<std::uint64_t> numbers;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(HashOf(std::to_string(i)));
    return numbers;
  };
  const SurfaceComparison found = CompareSurfaces(a, b, t, {.points = 300, .seed = 5}, nullptr,
                                                  {streams(3), streams(3), streams(1)});
  auto measures = Measures(folder / "c.csv");
  const auto expect = [&](const std::string& name, double samples, std::optional<double> other) {
    EXPECT_EQ(measures[name].samples, FormatDouble(samples)) << name;
    EXPECT_EQ(measures[name].reference, other ? FormatDouble(*other) : "") << name;
    EXPECT_NE(samples, other.value_or(-1.0)) << name << " tells nothing apart";
  };
  EXPECT_EQ(measures["shapes"].samples, "3");
  EXPECT_EQ(measures["shapes"].reference, "3");
  expect("left_out", 0, 1);
  expect("size", found.samples.size, found.reference.size);
  expect("coverage", found.sets.coverage, std::nullopt);
  expect("nna", found.sets.nna, std::nullopt);
  expect("matching", found.sets.matching, std::nullopt);
  expect("nearest_reference", found.sets.to_reference, found.sets.within_reference);
  expect("floor", found.samples.floor, found.reference.floor);
  expect("near_duplicates", found.spread.samples.duplicates, found.spread.reference.duplicates);
  expect("mean_distance", found.spread.samples.mean_distance, found.spread.reference.mean_distance);
  expect("diversity", found.spread.diversity, std::nullopt);
  expect("vendi", found.samples.vendi, found.reference.vendi);
  EXPECT_EQ(measures["roughness"].samples, FormatDouble(found.samples.roughness));
  EXPECT_EQ(measures["roughness"].reference, FormatDouble(found.reference.roughness));
  expect("flat_share", found.samples.flat, found.reference.flat);
  expect("crease_share", found.samples.crease, found.reference.crease);
  expect("dihedral_distance", found.dihedral_distance, std::nullopt);
  ASSERT_TRUE(found.normals);
  expect("coverage_normals", found.normals->coverage, std::nullopt);
  expect("nna_normals", found.normals->nna, std::nullopt);
  ASSERT_TRUE(found.memorisation);
  expect("nearest_training", found.memorisation->samples, found.memorisation->reference);
  expect("nearer_to_training", found.memorisation->nearer, std::nullopt);
  EXPECT_EQ(measures.size(), 20U);
  // Diagonals by hand: the files hold single precision.
  const auto mean = [](double x, double y, double z) {
    return (std::sqrt(2 + x * x) + std::sqrt(2 + y * y) + std::sqrt(2 + z * z)) / 3.0;
  };
  EXPECT_NEAR(found.samples.size, mean(1.0, 1.01, 1.5), 1e-6);
  EXPECT_NEAR(found.reference.size, mean(1.0, 2.0, 4.0), 1e-6);
}

TEST(CompareCli, TakesAsManyShapesOfBothSetsAsAskedFor) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make bottles --count 6 --seed 1 --out " + dir + "a.h5").code, 0);
  ASSERT_EQ(Antigrasp("dataset make bottles --count 4 --seed 2 --out " + dir + "b.h5").code, 0);
  const std::string sets = "compare " + dir + "a.h5 " + dir + "b.h5 --points 100 --out " + dir;
  ASSERT_EQ(Antigrasp(sets + "all.csv").code, 0);
  EXPECT_EQ(Measures(folder / "all.csv")["shapes"].samples, "4");
  EXPECT_EQ(Measures(folder / "all.csv").count("nearer_to_training"), 0u);
  EXPECT_EQ(Measures(folder / "all.csv").count("nna_normals"), 1u);
  ASSERT_EQ(Antigrasp(sets + "plain.csv --normals 0").code, 0);
  EXPECT_EQ(Measures(folder / "plain.csv").count("nna_normals"), 0u);
  ASSERT_EQ(Antigrasp(sets + "three.csv --count 3").code, 0);
  EXPECT_EQ(Measures(folder / "three.csv")["shapes"].reference, "3");
  ASSERT_EQ(Antigrasp(sets + "other.csv --seed 2").code, 0);
  EXPECT_NE(ReadFile(folder / "all.csv"), ReadFile(folder / "other.csv"));
}

TEST(CompareCli, TheSameShapesAreKeptAndDrawnInAnyOrder) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make bottles --count 6 --seed 1 --out " + dir + "a.h5").code, 0);
  ASSERT_EQ(Antigrasp("dataset make bottles --count 6 --seed 2 --out " + dir + "b.h5").code, 0);
  ShapeSet set = ReadShapeSet(folder / "a.h5");
  std::reverse(set.grids.begin(), set.grids.end());
  std::reverse(set.names.begin(), set.names.end());
  WriteShapeSet(folder / "turned.h5", set);
  for (const char* name : {"a", "turned"}) {
    ASSERT_EQ(Antigrasp("compare " + dir + name + ".h5 " + dir + "b.h5 --count 2 --points 100 " +
                        "--out " + dir + name + ".csv")
                  .code,
              0);
  }
  auto one = Measures(folder / "a.csv"), two = Measures(folder / "turned.csv");
  EXPECT_EQ(one["size"].samples, two["size"].samples);
  EXPECT_EQ(one["floor"].samples, two["floor"].samples);
  EXPECT_EQ(one["mean_distance"].samples, two["mean_distance"].samples);
}

TEST(CompareCli, DrawsEitherSetByAStreamOfItsOwn) {
  const TempFolder folder;
  WriteSets(folder);
  const std::string set = (folder / "b").string(), table = (folder / "c.csv").string();
  const Outcome outcome =
      Antigrasp("compare " + set + " " + set + " --count 2 --points 20 --out " + table);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  // Boxes of six sizes: two others of them have another mean diagonal.
  const Pair size = Measures(folder / "c.csv")["size"];
  EXPECT_NE(size.samples, size.reference);
}

TEST(CompareCli, CountsGridsThatAreNoSolidByReason) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ASSERT_EQ(Antigrasp("dataset make bottles --count 4 --out " + dir + "a.h5").code, 0);
  ShapeSet set = ReadShapeSet(folder / "a.h5");
  for (float& value : set.grids[1].values) value = -1.0F;
  WriteShapeSet(folder / "b.h5", set);
  const Outcome outcome =
      Antigrasp("compare " + dir + "b.h5 " + dir + "a.h5 --points 50 --out " + dir + "c.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("4 objects: 3 ok, 1 empty"), std::string::npos) << outcome.text;
  EXPECT_EQ(Measures(folder / "c.csv")["left_out"].samples, "1");
  EXPECT_EQ(Measures(folder / "c.csv")["shapes"].reference, "3");
}

TEST(CompareCli, WarnsOfOtherUnits) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteSets(folder);
  fs::create_directory(folder / "mm");
  for (const char* name : {"p.stl", "q.stl"}) {
    WriteMesh(folder / "mm" / name, shapes::Box({40, 50, 60}));
  }
  const Outcome outcome = Antigrasp("compare " + dir + "mm " + dir + "b --points 50");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.text.find("same unit?"), std::string::npos) << outcome.text;
}

TEST(CompareCli, RefusesBadInputAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", out = " --out " + dir + "c.csv";
  WriteSets(folder);
  ExpectRefused("compare " + dir + "none " + dir + "b" + out, "no such file");
  ExpectRefused("compare " + dir + "a", "REFERENCE");
  ExpectRefused("compare " + dir + "a " + dir + "b --count 1" + out, "--count");
  ExpectRefused("compare " + dir + "a " + dir + "b --points 0" + out, "--points");
  ExpectRefused("compare " + dir + "a " + dir + "b --normals -1" + out, "--normals");
  ExpectRefused("compare " + dir + "a " + dir + "b --out " + dir + "none/c.csv", "none");
  folder.Write("text.txt", "no mesh");
  ExpectRefused("compare " + dir + "text.txt " + dir + "b" + out, "text.txt");
  // One solid is no set.
  const Outcome one = Antigrasp("compare " + dir + "a/1.stl " + dir + "b" + out);
  EXPECT_EQ(one.code, 2);
  EXPECT_NE(one.text.find("antigrasp: 1 solids"), std::string::npos) << one.text;
  EXPECT_FALSE(fs::exists(folder / "c.csv"));
}

}  // namespace
}  // namespace antigrasp
