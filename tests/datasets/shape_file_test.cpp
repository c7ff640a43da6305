// The file format from the other side: by the HDF5 library alone, so that a mistake made in writing
// and in reading alike is seen.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <array>
#include <filesystem>
#include <limits>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_set.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

// The value at node (x, y, z) of grid i tells where it belongs.
float Mark(int i, int x, int y, int z) {
  return static_cast<float>(1000 * i + 100 * z + 10 * y + x);
}

ShapeSet Marked() {
  ShapeSet set;
  set.kind = "prisms";
  set.seed = 0x0102030405060708U;
  set.provenance = "by hand";
  set.truncation = 0.125;
  for (int i = 0; i < 2; ++i) {
    SdfGrid grid{3, 0.25, {1, 2, 3}, std::vector<float>(27)};
    for (int z = 0; z < 3; ++z) {
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) grid.values[grid.Index(x, y, z)] = Mark(i, x, y, z);
      }
    }
    set.grids.push_back(grid);
    set.names.push_back(i == 0 ? "one" : "zw\xC3\xB6lf");
  }
  return set;
}

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : id_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    EXPECT_GE(id_, 0);
  }
  ~OpenFile() { H5Fclose(id_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  hid_t get() const { return id_; }

 private:
  hid_t id_;
};

std::string TextOf(hid_t file, const char* name, const char* object = "/") {
  const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  EXPECT_EQ(H5Tget_class(type), H5T_STRING) << name;
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_UTF8) << name;
  EXPECT_EQ(H5Tget_strpad(type), H5T_STR_NULLPAD) << name;  // no room for a zero at the end
  std::string text(H5Tget_size(type), '?');
  H5Aread(attribute, type, text.data());
  H5Tclose(type);
  H5Aclose(attribute);
  return text;
}

std::vector<double> DoublesOf(hid_t file, const char* name) {
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT), type = H5Aget_type(attribute);
  const hid_t space = H5Aget_space(attribute);
  EXPECT_GT(H5Tequal(type, H5T_IEEE_F64LE), 0) << name;
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data());
  H5Sclose(space);
  H5Tclose(type);
  H5Aclose(attribute);
  return values;
}

std::uint64_t WholeOf(hid_t file, const char* name) {
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT), type = H5Aget_type(attribute);
  EXPECT_GT(H5Tequal(type, H5T_STD_U64LE), 0) << name;
  std::uint64_t value = 0;
  H5Aread(attribute, H5T_NATIVE_UINT64, &value);
  H5Tclose(type);
  H5Aclose(attribute);
  return value;
}

hsize_t AttributesOf(hid_t file, const char* object) {
  H5O_info_t info{};
  EXPECT_GE(H5Oget_info_by_name(file, object, &info, H5P_DEFAULT), 0);
  return info.num_attrs;
}

TEST(ShapeFile, HoldsEveryAttributeUnderItsName) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Marked());
  // The layout of HDF5 1.8: its superblock is version 2.
  EXPECT_EQ(ReadFile(folder / "a.h5").substr(0, 9), "\x89HDF\r\n\x1A\n\x02");
  const OpenFile file(folder / "a.h5");
  EXPECT_EQ(TextOf(file.get(), "format"), "antigrasp.sdf");
  EXPECT_EQ(WholeOf(file.get(), "version"), 2U);
  EXPECT_EQ(TextOf(file.get(), "kind"), "prisms");
  EXPECT_EQ(WholeOf(file.get(), "seed"), 0x0102030405060708U);
  EXPECT_EQ(DoublesOf(file.get(), "spacing"), std::vector<double>{0.25});
  EXPECT_EQ(DoublesOf(file.get(), "origin"), (std::vector<double>{1, 2, 3}));  // x, y, z
  EXPECT_EQ(DoublesOf(file.get(), "truncation"), std::vector<double>{0.125});
  EXPECT_EQ(TextOf(file.get(), "provenance"), "by hand");
  EXPECT_EQ(TextOf(file.get(), "sign", "/sdf"), "positive inside");
  EXPECT_EQ(TextOf(file.get(), "unit", "/sdf"), "side of the unit cube");
  // Of a ninth attribute HDF5 would make an index that other readers do not know.
  EXPECT_EQ(AttributesOf(file.get(), "/"), 8U);
  EXPECT_EQ(AttributesOf(file.get(), "/sdf"), 2U);
}

TEST(ShapeFile, HoldsTheGridsWithXFastestOneChunkEach) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Marked());
  const OpenFile file(folder / "a.h5");
  const hid_t set = H5Dopen2(file.get(), "/sdf", H5P_DEFAULT), type = H5Dget_type(set);
  const hid_t space = H5Dget_space(set), properties = H5Dget_create_plist(set);
  EXPECT_GT(H5Tequal(type, H5T_IEEE_F32LE), 0);
  std::array<hsize_t, 4> extents{}, chunk{};
  ASSERT_EQ(H5Sget_simple_extent_ndims(space), 4);
  H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  EXPECT_EQ(extents, (std::array<hsize_t, 4>{2, 3, 3, 3}));
  EXPECT_EQ(H5Pget_chunk(properties, 4, chunk.data()), 4);
  EXPECT_EQ(chunk, (std::array<hsize_t, 4>{1, 3, 3, 3}));
  ASSERT_EQ(H5Pget_nfilters(properties), 3);
  unsigned level = 0, config = 0;
  std::size_t count = 0;
  EXPECT_EQ(H5Pget_filter2(properties, 0, nullptr, &count, nullptr, 0, nullptr, &config),
            H5Z_FILTER_SHUFFLE);
  count = 1;
  EXPECT_EQ(H5Pget_filter2(properties, 1, nullptr, &count, &level, 0, nullptr, &config),
            H5Z_FILTER_DEFLATE);
  EXPECT_EQ(level, 4U);
  count = 0;
  EXPECT_EQ(H5Pget_filter2(properties, 2, nullptr, &count, nullptr, 0, nullptr, &config),
            H5Z_FILTER_FLETCHER32);
  float values[2][3][3][3];  // grid, z, y, x
  EXPECT_GE(H5Dread(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), 0);
  for (int i = 0; i < 54; ++i) {
    const int x = i % 3, y = i / 3 % 3, z = i / 9 % 3;
    EXPECT_EQ(values[i / 27][z][y][x], Mark(i / 27, x, y, z));
  }
  H5Pclose(properties);
  H5Sclose(space);
  H5Tclose(type);
  H5Dclose(set);
}

TEST(ShapeFile, HoldsTheNamesInOneLengthFilledWithZeros) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Marked());
  const OpenFile file(folder / "a.h5");
  const hid_t set = H5Dopen2(file.get(), "/names", H5P_DEFAULT), type = H5Dget_type(set);
  EXPECT_EQ(H5Tget_cset(type), H5T_CSET_UTF8);
  EXPECT_EQ(H5Tget_strpad(type), H5T_STR_NULLPAD);
  ASSERT_EQ(H5Tget_size(type), 6U);
  std::string names(12, '?');
  EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, names.data()), 0);
  EXPECT_EQ(names, std::string("one\0\0\0zw\xC3\xB6lf", 12));
  H5Tclose(type);
  H5Dclose(set);
}

// Two files of one content are the same bytes in any second.
TEST(ShapeFile, HoldsNoTimes) {
  const TempFolder folder;
  WriteShapeSet(folder / "a.h5", Marked());
  const OpenFile file(folder / "a.h5");
  for (const char* name : {"/sdf", "/names"}) {
    const hid_t set = H5Dopen2(file.get(), name, H5P_DEFAULT);
    const hid_t properties = H5Dget_create_plist(set);
    hbool_t times = true;
    EXPECT_GE(H5Pget_obj_track_times(properties, &times), 0);
    EXPECT_FALSE(times) << name;
    H5Pclose(properties);
    H5Dclose(set);
  }
}

// A file by somebody else, in other types than ours where the format leaves the choice.
struct Foreign {
  std::string format = "antigrasp.sdf", kind = "bottles", sign = "positive inside",
              provenance = "another program";
  std::int32_t version = 1;
  const char* sign_of = "/";
  std::vector<double> spacing = {0.25}, origin = {1, 2, 3}, truncation = {0.5};
  std::vector<hsize_t> extents = {2, 2, 2, 2};
  std::vector<const char*> names = {"first", "second"};
  hid_t type = H5T_IEEE_F64BE;
  std::vector<hsize_t> chunk = {};  // of /sdf; none: all in one piece

  static void Attribute(hid_t file, const char* name, hid_t type, hid_t memory, const void* data,
                        hsize_t count) {
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Awrite(attribute, memory, data), 0) << name;
    H5Aclose(attribute);
    H5Sclose(space);
  }
  static void Text(hid_t file, const char* name, const std::string& value) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, value.size() + 1);
    Attribute(file, name, type, type, value.c_str(), 1);
    H5Tclose(type);
  }
  static void Reals(hid_t file, const char* name, const std::vector<double>& values) {
    Attribute(file, name, H5T_IEEE_F64BE, H5T_NATIVE_DOUBLE, values.data(), values.size());
  }
  static void Dataset(hid_t file, const char* name, hid_t type, hid_t memory, const void* data,
                      const std::vector<hsize_t>& extents, const std::vector<hsize_t>& chunk = {}) {
    const hid_t space = H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr);
    const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
    if (!chunk.empty()) H5Pset_chunk(made, static_cast<int>(chunk.size()), chunk.data());
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, made, H5P_DEFAULT);
    EXPECT_TRUE(data == nullptr || H5Dwrite(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    H5Dclose(set);
    H5Pclose(made);
    H5Sclose(space);
  }

  std::filesystem::path WriteTo(const std::filesystem::path& path) const {
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    Text(file, "format", format);
    Text(file, "kind", kind);
    Text(file, "provenance", provenance);
    const std::int32_t seed = 77;
    Attribute(file, "version", H5T_STD_I16BE, H5T_NATIVE_INT32, &version, 1);
    Attribute(file, "seed", H5T_STD_U32LE, H5T_NATIVE_INT32, &seed, 1);
    Reals(file, "spacing", spacing);
    Reals(file, "origin", origin);
    Reals(file, "truncation", truncation);
    std::vector<float> values;
    for (int i = 0; i < 16; ++i) values.push_back(Mark(i / 8, i % 2, i / 2 % 2, i / 4 % 2));
    const bool small = extents == std::vector<hsize_t>{2, 2, 2, 2};
    Dataset(file, "/sdf", type, H5T_NATIVE_FLOAT, small ? values.data() : nullptr, extents, chunk);
    const hid_t signed_object = H5Oopen(file, sign_of, H5P_DEFAULT);
    Text(signed_object, "sign", sign);
    H5Oclose(signed_object);
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, H5T_VARIABLE);
    Dataset(file, "/names", text, text, names.data(), {names.size()});
    H5Tclose(text);
    H5Fclose(file);
    return path;
  }
};

// Two grids of 64 bytes, each a chunk. The index of chunks begins with TREE and a one; 24 bytes on
// stand the stored bytes of the first.
TEST(ShapeFile, OfAnotherProgramInPlainChunksIsReadAndItsDamageSeen) {
  const TempFolder folder;
  const auto path = Foreign{.chunk = {1, 2, 2, 2}}.WriteTo(folder / "foreign.h5");
  const ShapeSet set = ReadShapeSet(path);
  EXPECT_EQ(set.grids[1].values[set.grids[1].Index(1, 0, 1)], Mark(1, 1, 0, 1));
  const std::string bytes = ReadFile(path);
  const std::size_t size_at = bytes.find("TREE\x01") + 24;
  ASSERT_EQ(bytes.substr(size_at, 4), std::string("\x40\0\0\0", 4));
  for (const char* damaged : {"\x08\0\0\0", "\x41\0\0\0", "\xFF\xFF\xFF\xFF"}) {
    std::string changed = bytes;
    changed.replace(size_at, 4, std::string(damaged, 4));
    const ShapeSetReader reader(folder.Write("damaged.h5", changed));
    EXPECT_THROW(reader.Grid(0), InputError);
    EXPECT_EQ(reader.Grid(1).values, set.grids[1].values);
  }
}

TEST(ShapeFile, OfAnotherProgramIsReadAsItIsMeant) {
  const TempFolder folder;
  const auto path = Foreign{}.WriteTo(folder / "foreign.h5");
  const ShapeSet set = ReadShapeSet(path);
  EXPECT_EQ(set.kind, "bottles");
  EXPECT_EQ(set.provenance, "another program");
  EXPECT_EQ(set.seed, 77U);
  EXPECT_EQ(set.truncation, 0.5);
  EXPECT_EQ(set.names, (std::vector<std::string>{"first", "second"}));
  ASSERT_EQ(set.grids.size(), 2U);
  for (int i = 0; i < 16; ++i) {
    const SdfGrid& grid = set.grids[static_cast<std::size_t>(i / 8)];
    EXPECT_EQ(grid.n, 2);
    EXPECT_EQ(grid.spacing, 0.25);
    EXPECT_EQ(grid.origin, Eigen::Vector3d(1, 2, 3));
    const int x = i % 2, y = i / 2 % 2, z = i / 4 % 2;
    EXPECT_EQ(grid.values[grid.Index(x, y, z)], Mark(i / 8, x, y, z));
  }
  const ShapeSetInfo info = ReadShapeSetInfo(path);
  EXPECT_EQ(info.spacing, 0.25);
  EXPECT_EQ(info.truncation, 0.5);
  EXPECT_EQ(info.seed, 77U);
  EXPECT_EQ(info.count, 2);
  EXPECT_EQ(info.n, 2);
  EXPECT_EQ(ReadShapeNames(path), set.names);
  EXPECT_TRUE(IsShapeSet(path));
}

std::string Refusal(const Foreign& content) {
  const TempFolder folder;
  const auto path = content.WriteTo(folder / "foreign.h5");
  try {
    ReadShapeSet(path);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    return text;
  }
  return "nothing thrown";
}

void ExpectRefused(const Foreign& content, const std::string& why) {
  const std::string text = Refusal(content);
  EXPECT_NE(text.find(why), std::string::npos) << why << ": " << text;
}

TEST(ShapeFile, IsRefusedForEachWrongAttributeByItsName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  ExpectRefused(Foreign{.format = "other.sdf"}, "format = \"other.sdf\"");
  ExpectRefused(Foreign{.sign = "negative inside"}, "sign = \"negative inside\"");
  ExpectRefused(Foreign{.sign = "negative inside", .version = 2, .sign_of = "/sdf"},
                "sign = \"negative inside\"");
  for (const double value : {0.0, -0.25, nan, infinity}) {
    ExpectRefused(Foreign{.spacing = {value}}, "spacing is not a length");
  }
  for (const double value : {-0.25, nan, infinity}) {
    ExpectRefused(Foreign{.truncation = {value}}, "truncation is not a length");
  }
  ExpectRefused(Foreign{.spacing = {0.25, 0.25}}, "no usable attribute spacing");
  ExpectRefused(Foreign{.origin = {1, 2}}, "no usable attribute origin");
  ExpectRefused(Foreign{.origin = {1, 2, 3, 4}}, "no usable attribute origin");
  ExpectRefused(Foreign{.origin = {1, 2, nan}}, "no usable attribute origin");
}

// On the root group in version 1, on what they are of in version 2.
TEST(ShapeFile, HasTheSignWhereItsVersionSays) {
  const TempFolder folder;
  const ShapeSetInfo info =
      ReadShapeSetInfo(Foreign{.version = 2, .sign_of = "/sdf"}.WriteTo(folder / "foreign.h5"));
  EXPECT_EQ(info.version, 2);
  ExpectRefused(Foreign{.version = 2, .sign_of = "/"}, "no usable attribute sign of /sdf");
  ExpectRefused(Foreign{.version = 1, .sign_of = "/sdf"}, "no usable attribute sign (");
  ExpectRefused(Foreign{.version = 0}, "version = 0");
  ExpectRefused(Foreign{.version = 3}, "version = 3");
}

TEST(ShapeFile, IsRefusedForEachWrongDatasetByItsName) {
  ExpectRefused(Foreign{.names = {"first"}}, "dataset /names of 2 strings");
  ExpectRefused(Foreign{.names = {"first", "second", "third"}}, "dataset /names of 2 strings");
  ExpectRefused(Foreign{.type = H5T_STD_I32LE}, "no usable dataset /sdf");
  const std::vector<std::vector<hsize_t>> no_cubes = {
      {2, 2, 2, 3}, {2, 2, 3, 2}, {2, 3, 2, 2}, {2, 2, 2}, {2, 2, 2, 2, 2}, {1, 513, 513, 513}};
  for (const auto& extents : no_cubes) {
    ExpectRefused(Foreign{.extents = extents}, "no usable dataset /sdf");
  }
  ExpectRefused(Foreign{.extents = {1, 512, 512, 512}}, "dataset /sdf is incomplete");
}

TEST(ShapeFile, WithAnotherFormatIsNoShapeSet) {
  const TempFolder folder;
  EXPECT_FALSE(IsShapeSet(Foreign{.format = "other.sdf"}.WriteTo(folder / "foreign.h5")));
}

TEST(ShapeFile, HasOneSizeAndPlaceForAllGrids) {
  const TempFolder folder;
  ShapeSet set = Marked();
  set.grids[1].origin.z() = 2.5;
  EXPECT_THROW(WriteShapeSet(folder / "a.h5", set), std::logic_error);
  set = Marked();
  set.grids[1].spacing = 0.5;
  EXPECT_THROW(WriteShapeSet(folder / "a.h5", set), std::logic_error);
  set = Marked();
  set.grids[1].values.pop_back();
  EXPECT_THROW(WriteShapeSet(folder / "a.h5", set), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
