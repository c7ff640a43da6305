// SDF files written and read a grid at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/shape_set.h"
#include "tests/support/child_process.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::ChildProcess;
using shapes::TempFolder;

// Values that differ from node to node and from grid to grid, and do not compress well.
SdfGrid Numbered(int i) {
  SdfGrid grid = UnitCubeGrid(16);
  RngStream rng(1, "numbered grid", static_cast<std::uint64_t>(i));
  for (float& value : grid.values) value = static_cast<float>(rng.Uniform(-1.0, 1.0));
  return grid;
}

std::string NameOf(int i) { return "shape-" + std::to_string(i); }

void WriteNumbered(const std::filesystem::path& path, int count) {
  ShapeSetWriter writer(path, {.kind = "prisms", .seed = 3}, static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) writer.Add(NameOf(i), Numbered(i));
  EXPECT_FALSE(std::filesystem::exists(path));
  writer.Commit();
}

TEST(ShapeStream, GridsAddedOneByOneAreReadAsTheSet) {
  const TempFolder folder;
  WriteNumbered(folder / "a.h5", 20);
  const ShapeSet set = ReadShapeSet(folder / "a.h5");
  EXPECT_EQ(set.kind, "prisms");
  EXPECT_EQ(set.seed, 3U);
  ASSERT_EQ(set.grids.size(), 20U);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(set.names[static_cast<std::size_t>(i)], NameOf(i));
    EXPECT_EQ(set.grids[static_cast<std::size_t>(i)].values, Numbered(i).values);
  }
  WriteShapeSet(folder / "b.h5", set);
  EXPECT_EQ(ReadFile(folder / "a.h5"), ReadFile(folder / "b.h5"));
}

TEST(ShapeStream, ManyThreadsReadTheGridsOfTwoFilesInAnyOrder) {
  const TempFolder folder;
  WriteNumbered(folder / "a.h5", 30);
  WriteNumbered(folder / "b.h5", 50);
  const ShapeSetReader a(folder / "a.h5"), b(folder / "b.h5");
  EXPECT_EQ(a.info().count, 30);
  EXPECT_EQ(b.Names().back(), NameOf(49));
  std::vector<int> right(300, 0);
  ParallelFor(std::ssize(right), 4, [&](std::int64_t i) {
    const int number = static_cast<int>(i * 7 % 30);
    right[static_cast<std::size_t>(i)] =
        (i % 2 == 0 ? a : b).Grid(number).values == Numbered(number).values;
  });
  EXPECT_EQ(std::count(right.begin(), right.end(), 1), std::ssize(right));
}

TEST(ShapeStream, AWriterThatIsNotFinishedLeavesNothing) {
  const TempFolder folder;
  {
    ShapeSetWriter writer(folder / "a.h5", {.kind = "prisms"}, 3);
    writer.Add("first", Numbered(0));
  }
  { const ShapeSetWriter none(folder / "a.h5", {.kind = "prisms"}, 3); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(ShapeSetWriter(folder / "none/a.h5", {}, 1), InputError);
}

TEST(ShapeStream, AWriterTakesAsManyGridsAsWereAnnounced) {
  const TempFolder folder;
  ShapeSetWriter writer(folder / "a.h5", {.kind = "prisms"}, 1);
  EXPECT_THROW(writer.Commit(), std::logic_error);
  writer.Add("first", Numbered(0));
  EXPECT_THROW(writer.Add("second", Numbered(1)), std::logic_error);
  writer.Commit();
  EXPECT_EQ(ReadShapeNames(folder / "a.h5"), std::vector<std::string>{"first"});
}

TEST(ShapeStream, ADamagedGridIsNamedWhenItIsReadAndTheOthersAreThere) {
  const TempFolder folder;
  WriteNumbered(folder / "a.h5", 9);
  std::string bytes = ReadFile(folder / "a.h5");
  // Chunks lie one behind the other at the end, before the names.
  bytes[bytes.size() * 3 / 4] = static_cast<char>(bytes[bytes.size() * 3 / 4] ^ 0x55);
  const ShapeSetReader reader(folder.Write("b.h5", bytes));
  int good = 0, bad = 0;
  for (int i = 0; i < 9; ++i) {
    try {
      EXPECT_EQ(reader.Grid(i).values, Numbered(i).values);
      ++good;
    } catch (const InputError& error) {
      ++bad;
      const std::string text = error.what();
      EXPECT_NE(text.find("grid " + std::to_string(i) + " of /sdf cannot be read"),
                std::string::npos);
    }
  }
  EXPECT_EQ(good, 8);
  EXPECT_EQ(bad, 1);
}

// Most memory that a process of its own held for the work, in KB; this one's own included.
long PeakOf(const std::function<void()>& work) {
  const ChildProcess child(work);
  EXPECT_TRUE(child.alive());
  std::ifstream status("/proc/" + std::to_string(child.pid()) + "/status");
  for (std::string word; status >> word;) {
    long peak = 0;
    if (word == "VmHWM:" && status >> peak) return peak;
  }
  return -1;
}

TEST(ShapeStream, TheIndexOfManyGridsIsNotKeptInMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "what is freed stays in memory for a while";
#endif
  const TempFolder folder;
  const auto write = [&](const std::string& name, int count) {
    return PeakOf([&folder, name, count] {
      const SdfGrid grid = UnitCubeGrid(2);
      ShapeSetWriter writer(folder / name, {.kind = "prisms"}, static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i) writer.Add("", grid);
      writer.Commit();
    });
  };
  const auto read = [&](const std::string& name) {
    return PeakOf([path = folder / name] {
      const ShapeSetReader reader(path);
      for (int i = 0; i < reader.info().count; i += 10) reader.Grid(i);
    });
  };
  const long few_written = write("few.h5", 100), many_written = write("many.h5", 20000);
  const long few_read = read("few.h5"), many_read = read("many.h5");
  EXPECT_LT(many_written - few_written, 6000);  // 9,900 with all of the index, else 3,800
  EXPECT_LT(many_read - few_read, 4000);        // 7,700 and 2,000
}

}  // namespace
}  // namespace antigrasp
