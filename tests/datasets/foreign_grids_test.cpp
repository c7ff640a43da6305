// Grids as NumPy and VTK have them: bytes, what files say of themselves, and what is checked.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/grid_check.h"
#include "antigrasp/datasets/import_grids.h"
#include "antigrasp/datasets/shape_set.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;
namespace fs = std::filesystem;

// A ball of this radius about a point of its own, in the unit cube.
SdfGrid BallGrid(int n, double radius) {
  SdfGrid grid = UnitCubeGrid(n);
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const double distance = (grid.Node(x, y, z) - Eigen::Vector3d(0.02, 0.01, -0.03)).norm();
        grid.values[grid.Index(x, y, z)] = static_cast<float>(radius - distance);
      }
    }
  }
  return grid;
}

ShapeSet TwoBalls() {
  ShapeSet set;
  set.kind = "prisms";
  set.seed = 0xFEDCBA9876543210U;  // no double holds it
  set.provenance = "by hand, <zw\xC3\xB6lf>";
  set.truncation = 0.125;
  set.side = 0.3;
  set.names = {"one \"&\"", "zw\xC3\xB6lf"};
  set.grids = {BallGrid(8, 0.3), BallGrid(8, 0.2)};
  return set;
}

std::string RawFloats(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

// A file of numpy.save, version 1.
std::string Npy(const std::string& dictionary, const std::string& values) {
  std::string text = dictionary + "\n";
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size()) +
         std::string(1, '\0') + text + values;
}

std::string Dictionary(const std::string& type, const std::string& shape,
                       const std::string& fortran = "False") {
  return "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': (" + shape + "), }";
}

std::string GridsRefusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  return "nothing thrown";
}

void ExpectGridsRefused(const std::string& name, const std::string& bytes,
                        const std::string& part) {
  const TempFolder folder;
  const fs::path path = folder.Write(name, bytes);
  const std::string text = GridsRefusal([&] { ReadShapeSet(path); });
  EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks " << part;
  EXPECT_NE(text.find(path.string()), std::string::npos) << text;
}

TEST(ForeignGrids, AnArrayOfNumpyIsItsHeaderInBlocksOf64AndTheFloatsXFastest) {
  const TempFolder folder;
  ShapeSet set;
  set.names = {"a", "b"};
  for (int i = 0; i < 2; ++i) {
    SdfGrid grid = UnitCubeGrid(2);
    for (std::size_t k = 0; k < 8; ++k)
      grid.values[k] = static_cast<float>(10 * i) + static_cast<float>(k);
    set.grids.push_back(grid);
  }
  WriteShapeSet(folder / "a.npy", set);
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 2, 2), }";
  header += std::string(128 - 10 - 1 - header.size(), ' ') + "\n";
  EXPECT_EQ(ReadFile(folder / "a.npy"),
            std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header +
                RawFloats({0, 1, 2, 3, 4, 5, 6, 7, 10, 11, 12, 13, 14, 15, 16, 17}));
}

TEST(ForeignGrids, ArchivesAndImagesGiveBackEverythingThatAnSdfFileHolds) {
  const TempFolder folder;
  const ShapeSet set = TwoBalls();
  for (const std::string name : {"a.npz", "a.vti", "a.h5"}) {
    WriteShapeSet(folder / name, set);
    const ShapeSet read = ReadShapeSet(folder / name);
    EXPECT_EQ(read.kind, set.kind) << name;
    EXPECT_EQ(read.seed, set.seed) << name;
    EXPECT_EQ(read.provenance, set.provenance) << name;
    EXPECT_EQ(read.truncation, set.truncation) << name;
    EXPECT_EQ(read.side, set.side) << name;
    EXPECT_EQ(read.names, set.names) << name;
    ASSERT_EQ(read.grids.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(read.grids[i].values, set.grids[i].values) << name;
      EXPECT_EQ(read.grids[i].spacing, 0.125) << name;
      EXPECT_EQ(read.grids[i].origin, set.grids[i].origin) << name;
    }
  }
}

TEST(ForeignGrids, EqualSetsAreEqualBytesAndNothingIsLeftBesideThem) {
  const TempFolder folder;
  for (const std::string extension : {".npy", ".npz", ".vti"}) {
    WriteShapeSet(folder / ("a" + extension), TwoBalls());
    WriteShapeSet(folder / ("b" + extension), TwoBalls());
    EXPECT_EQ(ReadFile(folder / ("a" + extension)), ReadFile(folder / ("b" + extension)));
  }
  EXPECT_EQ(shapes::CountFiles(folder.path()), 6);
}

TEST(ForeignGrids, AnArrayAloneIsNamedAfterItsFile) {
  const TempFolder folder;
  WriteShapeSet(folder / "mine.npy", TwoBalls());
  const ShapeSet read = ReadShapeSet(folder / "mine.npy");
  EXPECT_EQ(read.names, (std::vector<std::string>{"mine-000000", "mine-000001"}));
  EXPECT_EQ(read.kind, "import");
  EXPECT_EQ(read.side, 0.0);
  EXPECT_EQ(read.grids[1].values, TwoBalls().grids[1].values);
}

TEST(ForeignGrids, FloatsOfEverySizeAndAChannelOfOneAreTaken) {
  const TempFolder folder;
  const std::vector<float> ball = BallGrid(8, 0.3).values;
  std::string doubles;
  for (const float value : ball) {
    const double wide = static_cast<double>(value);
    doubles.append(reinterpret_cast<const char*>(&wide), sizeof wide);
  }
  const auto path = folder.Write("a.npy", Npy(Dictionary("<f8", "1, 1, 8, 8, 8"), doubles));
  EXPECT_EQ(ReadShapeSet(path).grids.at(0).values, ball);
  // Half precision: sign, 5 bits of exponent from -15, 10 of the fraction. -2 and 0.75.
  std::string halves;
  for (int i = 0; i < 8; ++i)
    halves += i == 0 ? std::string("\x00\xC0", 2) : std::string("\x00\x3A", 2);
  const auto half = folder.Write("b.npy", Npy(Dictionary("<f2", "2, 2, 2"), halves));
  // Seven of eight nodes, all of them at the border, are inside.
  EXPECT_NE(GridsRefusal([&] { ReadShapeSet(half); }).find("inside at the border"),
            std::string::npos);
  const ShapeSetReader turned(half, {GridSign::kNegativeInside, 0.0});
  EXPECT_EQ(turned.Grid(0).values[0], 2.0F);
  EXPECT_EQ(turned.Grid(0).values[7], -0.75F);
}

TEST(ForeignGrids, OtherSignsAreStatedAndChecked) {
  const TempFolder folder;
  SdfGrid ball = BallGrid(8, 0.3);
  for (float& value : ball.values) value = -value;
  const auto path =
      folder.Write("a.npy", Npy(Dictionary("<f4", "8, 8, 8"), RawFloats(ball.values)));
  EXPECT_EQ(GridsRefusal([&] { ReadShapeSet(path); }),
            "inside at the border where positive is inside (" + path.string() +
                "): expected --sign negative-inside of antigrasp dataset import");
  const ShapeSetReader turned(path, {GridSign::kNegativeInside, 0.0});
  EXPECT_EQ(turned.Grid(0).values, BallGrid(8, 0.3).values);
  EXPECT_EQ(turned.Names(), std::vector<std::string>{"a"});
  WriteShapeSet(folder / "ours.npy", {.kind = "x", .names = {"a"}, .grids = {BallGrid(8, 0.3)}});
  EXPECT_NE(GridsRefusal([&] {
              const ShapeSetReader wrong(folder / "ours.npy", {GridSign::kNegativeInside, 0.0});
            }).find("--sign positive-inside"),
            std::string::npos);
}

TEST(ForeignGrids, AGridWithoutASurfaceIsRefusedByNameAndOthersAreTaken) {
  const TempFolder folder;
  SdfGrid nothing = BallGrid(8, 0.3);
  for (float& value : nothing.values) value = -0.1F;
  const auto both = folder / "both.npz", empty = folder / "empty.npz";
  WriteShapeSet(both,
                {.kind = "x", .names = {"ball", "air"}, .grids = {BallGrid(8, 0.3), nothing}});
  WriteShapeSet(empty, {.kind = "x", .names = {"air"}, .grids = {nothing}});
  const std::vector<ImportedMesh> reports = ImportGrids({both}, folder / "out.h5", {}, 1);
  EXPECT_EQ(reports[0].status, "accepted");
  EXPECT_EQ(reports[1].status, "refused");
  EXPECT_EQ(reports[1].detail, "no surface: outside everywhere");
  EXPECT_EQ(ReadShapeSet(folder / "out.h5").names, std::vector<std::string>{"ball"});
  EXPECT_THROW(ImportGrids({empty}, folder / "none.h5", {}, 1), InputError);
  EXPECT_FALSE(fs::exists(folder / "none.h5"));
}

TEST(ForeignGrids, AFileThatSaysItsSignTakesNoOther) {
  const TempFolder folder;
  for (const std::string name : {"a.npz", "a.vti", "a.h5"}) {
    WriteShapeSet(folder / name, TwoBalls());
    EXPECT_NE(GridsRefusal([&] {
                const ShapeSetReader wrong(folder / name, {GridSign::kPositiveInside, 0.0});
              }).find("--sign (" + (folder / name).string() + "): expected none"),
              std::string::npos);
  }
}

// Voxels of 0.5 in a file: 8 of them are a cube of 4.
TEST(ForeignGrids, OtherSpacingsAreStatedAndChecked) {
  const TempFolder folder;
  SdfGrid ball = BallGrid(8, 0.3);
  for (float& value : ball.values) value *= 4.0F;
  const auto path =
      folder.Write("a.npy", Npy(Dictionary("<f4", "8, 8, 8"), RawFloats(ball.values)));
  const std::string text = GridsRefusal([&] { ReadShapeSet(path); });
  EXPECT_NE(text.find("values that change by 3.88 times"), std::string::npos) << text;
  EXPECT_NE(text.find("--spacing of antigrasp dataset import: about 0.485"), std::string::npos)
      << text;
  const ShapeSetReader told(path, {GridSign::kOfFile, 0.5});
  EXPECT_EQ(told.info().side, 4.0);
  EXPECT_EQ(told.info().spacing, 0.125);
  EXPECT_EQ(told.Grid(0).values, BallGrid(8, 0.3).values);
}

TEST(ForeignGrids, TheSlopeOfDistancesIsTheSpacing) {
  SdfGrid grid = UnitCubeGrid(8);
  for (int z = 0; z < 8; ++z) {
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x)
        grid.values[grid.Index(x, y, z)] = 0.3F * (static_cast<float>(x) - 3.4F);
    }
  }
  EXPECT_NEAR(SlopeAtSurface(grid), 0.3, 1e-6);
  // Of the 296 nodes at the border 64 + 3 * 28 lie at x = 0 to 3, as many at 4 to 7.
  EXPECT_EQ(BorderInside(grid), 0.5);
  grid.values.assign(512, -1.0F);
  EXPECT_EQ(SlopeAtSurface(grid), 0.0);
  EXPECT_EQ(BorderInside(grid), 0.0);
}

TEST(ForeignGrids, HeadersOfNumpyAreNotBelieved) {
  const std::string floats = RawFloats(std::vector<float>(8, -1.0F));
  ExpectGridsRefused("a.npy", "", "no NumPy array");
  ExpectGridsRefused("a.npy", std::string("\x93NUMPY\x09\x00\x10\x00{             }", 26),
                     "NumPy format 9");
  ExpectGridsRefused("a.npy", std::string("\x93NUMPY\x01\x00\xFF\xFF{}", 12),
                     "truncated or damaged");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "2, 2, 2"), floats.substr(1)), "bytes");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "2, 2, 2"), floats + "x"), "bytes");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "1000000, 2, 2, 2"), floats), "bytes");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "99999999999999999999, 2, 2, 2"), floats),
                     "grids of");
  // 2^64 + 1: comes round to 1 in 64 bits.
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "18446744073709551617, 2, 2, 2"), floats),
                     "grids of");
  ExpectGridsRefused(
      "a.npy", Npy("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 2, 2), 'x'", floats),
      "truncated or damaged");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "1, 1024, 1024, 1024"), floats), "1024 nodes");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "2, 2"), floats), "shape [2, 2]");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "2, 2, 3"), floats), "shape [2, 2, 3]");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "2, -2, 2"), floats), "damaged shape");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<f4", "2, 2, 2", "True"), floats), "Fortran order");
  ExpectGridsRefused("a.npy", Npy(Dictionary(">f4", "2, 2, 2"), floats), "big-endian");
  ExpectGridsRefused("a.npy", Npy(Dictionary("|O", "2, 2, 2"), floats), "Python objects");
  ExpectGridsRefused("a.npy", Npy(Dictionary("<i4", "2, 2, 2"), floats), "'<i4'");
  ExpectGridsRefused(
      "a.npy", Npy("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (2, 2, 2)}", floats),
      "several fields");
  ExpectGridsRefused("a.npy", Npy("{'fortran_order': False, 'shape': (2, 2, 2)}", floats),
                     "without descr");
}

std::string Vti(const std::string& image, const std::string& points, const std::string& rest = "",
                const std::string& file = "byte_order=\"LittleEndian\"") {
  return "<?xml version=\"1.0\"?><VTKFile type=\"ImageData\" version=\"0.1\" " + file +
         "><ImageData " + image + "><Piece Extent=\"0 1 0 1 0 1\"><PointData>" + points +
         "</PointData></Piece></ImageData>" + rest + "</VTKFile>";
}
const std::string kTwoCubed =
    "WholeExtent=\"0 1 0 1 0 1\" Origin=\"0 0 0\" Spacing=\"0.5 0.5 0.5\"";
const std::string kAsciiArray =
    "<DataArray type=\"Float32\" Name=\"d\" format=\"ascii\">1 -1 -1 -1 -1 -1 -1 -1</DataArray>";

TEST(ForeignGrids, ImagesInTextAndBase64AreTaken) {
  const TempFolder folder;
  const ShapeSet text = ReadShapeSet(folder.Write("ball.vti", Vti(kTwoCubed, kAsciiArray)));
  EXPECT_EQ(text.names, std::vector<std::string>{"ball"});
  EXPECT_EQ(text.grids.at(0).values, (std::vector<float>{1, -1, -1, -1, -1, -1, -1, -1}));
  // 32 as 4 bytes, then 1 and seven times -1: python3 -c "import base64, struct;
  // print(base64.b64encode(struct.pack('<I8f', 32, 1, *7 * [-1])))".
  const std::string base64 = "IAAAAAAAgD8AAIC/AACAvwAAgL8AAIC/AACAvwAAgL8AAIC/";
  const std::string binary =
      "<DataArray type=\"Float32\" Name=\"d\" format=\"binary\">\n " + base64 + "\n</DataArray>";
  EXPECT_EQ(ReadShapeSet(folder.Write("b.vti", Vti(kTwoCubed, binary))).grids.at(0).values,
            text.grids[0].values);
  // The number of bytes encoded apart, and appended.
  const std::string apart = "IAAAAA==AACAPwAAgL8AAIC/AACAvwAAgL8AAIC/AACAvwAAgL8=";
  const std::string appended =
      Vti(kTwoCubed, "<DataArray type=\"Float32\" Name=\"d\" format=\"appended\" offset=\"0\"/>",
          "<AppendedData encoding=\"base64\">_" + apart + "</AppendedData>");
  EXPECT_EQ(ReadShapeSet(folder.Write("c.vti", appended)).grids.at(0).values, text.grids[0].values);
}

TEST(ForeignGrids, HeadersOfImagesAreNotBelieved) {
  const auto image = [](const std::string& extent, const std::string& spacing = "0.5 0.5 0.5",
                        const std::string& more = "") {
    return "WholeExtent=\"" + extent + "\" Origin=\"0 0 0\" Spacing=\"" + spacing + "\" " + more;
  };
  ExpectGridsRefused("a.vti", "", "XML");
  ExpectGridsRefused("a.vti", "<VTKFile type=\"ImageData\">", "XML");
  ExpectGridsRefused("a.vti", "<VTKFile type=\"PolyData\"/>", "'PolyData'");
  ExpectGridsRefused("a.vti", Vti(kTwoCubed, kAsciiArray, "", "byte_order=\"BigEndian\""),
                     "big-endian");
  ExpectGridsRefused("a.vti",
                     Vti(kTwoCubed, kAsciiArray, "", "compressor=\"vtkLZ4DataCompressor\""),
                     "'vtkLZ4DataCompressor'");
  ExpectGridsRefused("a.vti", Vti(image("0 1 0 1 0 2"), kAsciiArray), "no cube");
  ExpectGridsRefused("a.vti", Vti(image("0 999999999 0 999999999 0 999999999"), kAsciiArray),
                     "no cube");
  ExpectGridsRefused("a.vti", Vti(image("0 1 0 1 0 1", "0.5 0.5 0.4"), kAsciiArray), "spacing");
  ExpectGridsRefused("a.vti", Vti(image("0 1 0 1 0 1", "-1 -1 -1"), kAsciiArray), "spacing");
  ExpectGridsRefused(
      "a.vti", Vti(image("0 1 0 1 0 1", "1 1 1", "Direction=\"0 1 0 1 0 0 0 0 1\""), kAsciiArray),
      "turned axes");
  ExpectGridsRefused("a.vti", Vti(image("1 2 0 1 0 1"), kAsciiArray), "several pieces");
  ExpectGridsRefused("a.vti", Vti(kTwoCubed, ""), "no scalar");
  ExpectGridsRefused(
      "a.vti", Vti(kTwoCubed, "<DataArray type=\"Float32\" format=\"ascii\">1 2 3</DataArray>"),
      "3 values");
  ExpectGridsRefused(
      "a.vti", Vti(kTwoCubed, "<DataArray type=\"Float32\" format=\"binary\">AAAA</DataArray>"),
      "ends early");
  const std::string appended =
      "<DataArray type=\"Float32\" Name=\"d\" format=\"appended\" offset=\"";
  ExpectGridsRefused("a.vti", Vti(kTwoCubed, appended + "99999999999999999999\"/>"), "offset");
  ExpectGridsRefused("a.vti",
                     Vti(kTwoCubed, appended + "4000000000\"/>",
                         "<AppendedData encoding=\"raw\">_ </AppendedData>"),
                     "ends early");
  ExpectGridsRefused(
      "a.vti",
      Vti(kTwoCubed, appended + "0\"/>",
          "<AppendedData encoding=\"raw\">_" + std::string(40, '\xFF') + "</AppendedData>"),
      "an array of 4294967295 bytes");
  ExpectGridsRefused("a.vti", Vti(kTwoCubed, appended + "0\"/>" + kAsciiArray),
                     "both in the XML and appended");
  const std::string blocks("\xFF\xFF\xFF\xFF\xFF\xFF\xFF\x00\x00\x00\x00\x00 more of it", 23);
  ExpectGridsRefused("a.vti",
                     Vti(kTwoCubed, appended + "0\"/>",
                         "<AppendedData encoding=\"raw\">_" + blocks + "</AppendedData>",
                         "compressor=\"vtkZLibDataCompressor\""),
                     "packed blocks");
  ExpectGridsRefused("a.vti",
                     "<!DOCTYPE a [<!ENTITY b \"c\">]>" + Vti(kTwoCubed, kAsciiArray).substr(21),
                     "document type");
}

// Bytes overwritten at random: whatever comes of it is a set or an InputError.
TEST(ForeignGrids, DamagedFilesNeverDoMoreThanThrowInputError) {
  const TempFolder folder;
  for (const std::string extension : {".npy", ".npz", ".vti"}) {
    WriteShapeSet(folder / ("whole" + extension), TwoBalls());
    const std::string whole = ReadFile(folder / ("whole" + extension));
    for (int trial = 0; trial < 300; ++trial) {
      RngStream rng(12, extension, trial);
      std::string bytes = whole;
      if (rng.Below(8) == 0) bytes.resize(rng.Below(bytes.size()));
      for (std::uint64_t i = 0, n = 1 + rng.Below(8); i < n && !bytes.empty(); ++i) {
        // Most of the damage goes where headers and the directory of a zip archive are.
        const std::size_t range = std::min<std::size_t>(2000, bytes.size());
        const std::size_t at = rng.Below(3) == 0   ? rng.Below(bytes.size())
                               : rng.Below(2) == 0 ? rng.Below(range)
                                                   : bytes.size() - 1 - rng.Below(range);
        bytes[at] = static_cast<char>(rng.Below(256));
      }
      try {
        ReadShapeSet(folder.Write("damaged" + extension, bytes));
      } catch (const InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace antigrasp
