#include "antigrasp/datasets/shape_set.h"

#include <gtest/gtest.h>
#include <hdf5.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <limits>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

ShapeSet Sample(int count, int n = 6) {
  ShapeSet set;
  set.kind = "cylinders";
  set.seed = 0xFEDCBA9876543210U;
  set.provenance = "antigrasp dataset cylinders --count 3 (version 0.1.0)";
  set.truncation = 0.125;
  for (int i = 0; i < count; ++i) {
    RngStream rng(7, "shape-set-test", static_cast<std::uint64_t>(i));
    SdfGrid grid = UnitCubeGrid(n);
    for (float& v : grid.values) v = static_cast<float>(rng.Uniform(-1, 1));
    set.grids.push_back(std::move(grid));
    set.names.push_back("Flasche \xC3\xB6 " + std::string(static_cast<std::size_t>(i), 'x'));
  }
  return set;
}

void ExpectSame(const ShapeSet& a, const ShapeSet& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.provenance, b.provenance);
  EXPECT_EQ(a.truncation, b.truncation);
  EXPECT_EQ(a.names, b.names);
  ASSERT_EQ(a.grids.size(), b.grids.size());
  for (std::size_t i = 0; i < a.grids.size(); ++i) {
    EXPECT_EQ(a.grids[i].n, b.grids[i].n);
    EXPECT_EQ(a.grids[i].spacing, b.grids[i].spacing);
    EXPECT_EQ(a.grids[i].origin, b.grids[i].origin);
    EXPECT_EQ(a.grids[i].values, b.grids[i].values);
  }
}

// The message of the InputError that reading throws; it must name the file.
std::string ReadError(const std::filesystem::path& path) {
  try {
    ReadShapeSet(path);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

// A valid file, then changed by someone else.
std::filesystem::path Damaged(const TempFolder& folder, const std::function<void(hid_t)>& damage) {
  const auto path = folder / "damaged.h5";
  WriteShapeSet(path, Sample(3));
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  EXPECT_GE(file, 0);
  damage(file);
  H5Fclose(file);
  return path;
}

void WriteUint(hid_t file, const char* name, std::uint64_t value) {
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_UINT64, &value);
  H5Aclose(attribute);
}

void MakeEmptyDataset(hid_t file, const char* name, const std::vector<hsize_t>& extents) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr);
  const hid_t set =
      H5Dcreate2(file, name, H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dclose(set);
  H5Sclose(space);
}

TEST(ShapeSet, ReadsBackWhatWasWritten) {
  const TempFolder folder;
  const ShapeSet set = Sample(3);
  WriteShapeSet(folder / "a.h5", set);
  ExpectSame(ReadShapeSet(folder / "a.h5"), set);
  EXPECT_TRUE(IsShapeSet(folder / "a.h5"));
}

TEST(ShapeSet, EmptySetAndEmptyTextsReadBack) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", ShapeSet{});
  ExpectSame(ReadShapeSet(folder / "a.h5"), ShapeSet{});
}

TEST(ShapeSet, KeepsNonFiniteValuesForTheOneWhoCountsThem) {
  const TempFolder folder;
  ShapeSet set = Sample(1);
  set.grids[0].values[3] = std::numeric_limits<float>::infinity();
  set.grids[0].values[4] = std::numeric_limits<float>::quiet_NaN();
  WriteShapeSet(folder / "a.h5", set);
  const ShapeSet again = ReadShapeSet(folder / "a.h5");
  EXPECT_TRUE(std::isinf(again.grids[0].values[3]));
  EXPECT_TRUE(std::isnan(again.grids[0].values[4]));
}

TEST(ShapeSet, InfoTellsTheAttributesWithoutTheGrids) {
  const TempFolder folder;
  const ShapeSet set = Sample(3, 5);
  WriteShapeSet(folder / "a.h5", set);
  const ShapeSetInfo info = ReadShapeSetInfo(folder / "a.h5");
  EXPECT_EQ(info.kind, set.kind);
  EXPECT_EQ(info.provenance, set.provenance);
  EXPECT_EQ(info.seed, set.seed);
  EXPECT_EQ(info.count, 3);
  EXPECT_EQ(info.n, 5);
  EXPECT_EQ(info.version, 2);
  EXPECT_EQ(info.spacing, 0.2);
  EXPECT_EQ(info.truncation, 0.125);
  EXPECT_EQ(ReadShapeNames(folder / "a.h5"), set.names);
}

TEST(ShapeSet, WritingTwiceGivesTheSameBytes) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Sample(4));
  WriteShapeSet(folder / "b.h5", Sample(4));
  EXPECT_EQ(ReadFile(folder / "a.h5"), ReadFile(folder / "b.h5"));
}

TEST(ShapeSet, GridsThatDoNotMatchAreABug) {
  const TempFolder folder;
  ShapeSet set = Sample(2);
  set.grids[1] = UnitCubeGrid(5);
  EXPECT_THROW(WriteShapeSet(folder / "a.h5", set), std::logic_error);
  set = Sample(2);
  set.names.pop_back();
  EXPECT_THROW(WriteShapeSet(folder / "a.h5", set), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(ShapeSet, MissingFileFolderAndForeignBytesAreRefused) {
  const TempFolder folder;
  EXPECT_NE(ReadError(folder / "none.h5").find("no such file"), std::string::npos);
  EXPECT_NE(ReadError(folder.path()).find("folder"), std::string::npos);
  EXPECT_NE(ReadError(folder.Write("text.h5", "not at all")).find("not an HDF5"),
            std::string::npos);
  EXPECT_NE(ReadError(folder.Write("empty.h5", "")).find("not an HDF5"), std::string::npos);
  EXPECT_FALSE(IsShapeSet(folder / "none.h5"));
  EXPECT_FALSE(IsShapeSet(folder.path()));
  EXPECT_FALSE(IsShapeSet(folder / "text.h5"));
}

TEST(ShapeSet, FileCutAnywhereIsRefused) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Sample(3));
  const std::string bytes = ReadFile(folder / "a.h5");
  for (std::size_t part = 0; part < 16; ++part) {
    const std::string error =
        ReadError(folder.Write("cut.h5", bytes.substr(0, bytes.size() * part / 16)));
    EXPECT_TRUE(error.starts_with(part == 0 ? "not an HDF5 file" : "truncated HDF5 file")) << error;
  }
  for (const std::size_t left : {std::size_t{8}, std::size_t{95}, bytes.size() - 1}) {
    const std::string error = ReadError(folder.Write("cut.h5", bytes.substr(0, left)));
    EXPECT_TRUE(error.starts_with("truncated HDF5 file")) << left << error;
  }
  std::string zeros = bytes;
  std::fill(zeros.begin() + 8, zeros.end(), '\0');
  EXPECT_TRUE(ReadError(folder.Write("cut.h5", zeros)).starts_with("damaged HDF5 file"));
}

TEST(ShapeSet, DamagedBytesNeverCrash) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Sample(3));
  const std::string bytes = ReadFile(folder / "a.h5");
  RngStream rng(1, "damage");
  for (int trial = 0; trial < 200; ++trial) {
    std::string changed = bytes;
    for (int i = 0; i < 8; ++i)
      changed[rng.Below(changed.size())] = static_cast<char>(rng.Below(256));
    const auto path = folder.Write("damaged.h5", changed);
    try {
      ReadShapeSet(path);  // bytes that carry values may change unnoticed
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
  }
}

TEST(ShapeSet, Hdf5FileOfAnotherProgramIsRefused) {
  const TempFolder folder;
  const auto path = folder / "foreign.h5";
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  EXPECT_NE(ReadError(path).find("antigrasp.sdf"), std::string::npos);
  EXPECT_FALSE(IsShapeSet(path));
}

TEST(ShapeSet, NewerVersionIsRefusedByNumber) {
  const TempFolder folder;
  const auto path = Damaged(folder, [](hid_t file) { WriteUint(file, "version", 3); });
  EXPECT_NE(ReadError(path).find("version = 3"), std::string::npos);
  EXPECT_NE(ReadError(path).find("expected version 1 to 2"), std::string::npos);
}

TEST(ShapeSet, MissingPartsAreNamed) {
  const TempFolder folder;
  for (const char* name : {"/sdf", "/names"}) {
    const auto path = Damaged(folder, [&](hid_t file) { H5Ldelete(file, name, H5P_DEFAULT); });
    EXPECT_NE(ReadError(path).find(name), std::string::npos);
  }
  for (const char* name : {"kind", "seed", "spacing", "origin", "truncation", "provenance"}) {
    const auto path = Damaged(folder, [&](hid_t file) { H5Adelete(file, name); });
    EXPECT_NE(ReadError(path).find(name), std::string::npos);
  }
  const auto path =
      Damaged(folder, [&](hid_t file) { H5Adelete_by_name(file, "/sdf", "sign", H5P_DEFAULT); });
  EXPECT_NE(ReadError(path).find("sign of /sdf"), std::string::npos);
}

TEST(ShapeSet, WrongShapesAreRefusedBeforeAnythingIsAllocated) {
  const TempFolder folder;
  const std::vector<std::vector<hsize_t>> shapes = {
      {3, 6, 6},    {3, 6, 6, 7},          {3, 0, 0, 0},
      {2, 6, 6, 6}, {1, 4096, 4096, 4096}, {1U << 30, 6, 6, 6}};
  for (const auto& shape : shapes) {
    const auto path = Damaged(folder, [&](hid_t file) { MakeEmptyDataset(file, "/sdf", shape); });
    ReadError(path);
  }
}

TEST(ShapeSet, FailedWriteLeavesTheOldFile) {
  const TempFolder folder;
  const auto path = folder / "a.h5";
  WriteShapeSet(path, Sample(1));
  const std::string before = ReadFile(path);
  rlimit old_limit{};
  getrlimit(RLIMIT_FSIZE, &old_limit);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = old_limit;
  limit.rlim_cur = 20'000;
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(WriteShapeSet(path, Sample(50, 16)), RuntimeFailure);
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(ReadFile(path), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
  WriteShapeSet(path, Sample(50, 16));  // and nothing is stuck
  EXPECT_EQ(ReadShapeSet(path).grids.size(), 50U);
}

}  // namespace
}  // namespace antigrasp
