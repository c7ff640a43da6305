// The layout of SDF files below what HDF5's library shows: files of earlier versions, and the index
// of chunks, which other readers have to know and which has no check sum.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_set.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

// Written by version 0.1.0: the layout of HDF5 1.10, all attributes on the root group. The value at
// node (x, y, z) of grid i is 1000 i + 100 z + 10 y + x.
TEST(ShapeFileLayout, FilesOfVersionOneAreStillRead) {
  const std::string path = ANTIGRASP_TEST_DATA "/sdf/version_1.h5";
  EXPECT_EQ(ReadFile(path).substr(0, 9), "\x89HDF\r\n\x1A\n\x03");
  EXPECT_TRUE(IsShapeSet(path));
  EXPECT_EQ(ReadShapeSetInfo(path).version, 1);
  const ShapeSet set = ReadShapeSet(path);
  EXPECT_EQ(set.kind, "prisms");
  EXPECT_EQ(set.seed, 0x0102030405060708U);
  EXPECT_EQ(set.truncation, 0.125);
  EXPECT_EQ(set.names, (std::vector<std::string>{"one", "zw\xC3\xB6lf"}));
  ASSERT_EQ(set.grids.size(), 2U);
  for (int i = 0; i < 54; ++i) {
    const SdfGrid& grid = set.grids[static_cast<std::size_t>(i / 27)];
    EXPECT_EQ(grid.spacing, 0.25);
    EXPECT_EQ(grid.origin, Eigen::Vector3d(1, 2, 3));
    const int x = i % 3, y = i / 3 % 3, z = i / 9 % 3;
    EXPECT_EQ(grid.values[grid.Index(x, y, z)],
              static_cast<float>(1000 * (i / 27) + 100 * z + 10 * y + x));
  }
}

// The index of chunks is a tree whose nodes begin with TREE (HDF5 File Format Specification,
// III.A.1): type, level, 16 bits of how many, two addresses; then a key before every address: bytes
// stored, a mask of the filters passed by, and where the chunk begins along five extents.
class ChunkIndex : public testing::Test {
 protected:
  static constexpr std::size_t kKeys = 24, kKey = 56, kSize = 0, kMask = 4, kPlace = 8,
                               kAddress = 48;

  // Three grids that deflate to less than half.
  ChunkIndex() {
    ShapeSet set;
    for (int i = 0; i < 3; ++i) {
      set.grids.push_back(UnitCubeGrid(6));
      set.grids.back().values.assign(216, static_cast<float>(i + 1));
      set.names.push_back(std::to_string(i));
    }
    WriteShapeSet(path_, set);
    bytes_ = ReadFile(path_);
    tree_ = bytes_.find("TREE");
  }

  // What reading says when the number at `at` of the key of grid `i` is `value`.
  template <typename T>
  std::string With(std::size_t i, std::size_t at, T value) const {
    std::string changed = bytes_;
    std::memcpy(changed.data() + tree_ + kKeys + i * kKey + at, &value, sizeof value);
    const auto path = folder_.Write("changed.h5", changed);
    try {
      ReadShapeSet(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return "read";
  }
  std::string Refusal(int i) const {
    return "grid " + std::to_string(i) + " of /sdf cannot be read (" +
           (folder_ / "changed.h5").string() + "): expected an undamaged file";
  }

  const TempFolder folder_;
  const std::filesystem::path path_ = folder_ / "a.h5";
  std::string bytes_;
  std::size_t tree_ = 0;
};

TEST_F(ChunkIndex, IsTheTreeThatEveryReaderKnows) {
  ASSERT_NE(tree_, std::string::npos);
  EXPECT_EQ(bytes_.substr(tree_, 8), std::string("TREE\x01\0\x03\0", 8));
  EXPECT_EQ(With(1, kMask, std::uint32_t{0}), "read");
}

TEST_F(ChunkIndex, AChunkThatPassedAFilterByIsRefused) {
  EXPECT_EQ(With(1, kMask, std::uint32_t{1}), Refusal(1));  // shuffle
  EXPECT_EQ(With(1, kMask, std::uint32_t{2}), Refusal(1));  // deflate
  EXPECT_EQ(With(2, kMask, std::uint32_t{4}), Refusal(2));  // check sum
  EXPECT_EQ(With(0, kMask, std::uint32_t{8}), Refusal(0));  // there is no such filter
  EXPECT_EQ(With(0, kMask, ~std::uint32_t{0}), Refusal(0));
}

// What the index says of a chunk's size is memory to ask for before anything is read, and HDF5
// 1.10.8 crashes on one that is smaller than its check sum.
TEST_F(ChunkIndex, AChunkOfAnotherSizeIsRefused) {
  for (const std::uint32_t bytes : {0U, 1U, 3U, 4U, 5U, 2U * 864U + 4097U, ~0U}) {
    EXPECT_EQ(With(1, kSize, bytes), Refusal(1)) << bytes;
  }
}

TEST_F(ChunkIndex, AMissingChunkIsNoGridOfZeros) {
  EXPECT_EQ(With(2, kPlace, std::uint64_t{7}), Refusal(2));
  EXPECT_EQ(With(1, kAddress, ~std::uint64_t{0}), Refusal(1));
}

}  // namespace
}  // namespace antigrasp
