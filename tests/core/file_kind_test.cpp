#include "antigrasp/core/file_kind.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

TEST(FileKind, IsSaidByTheFirstBytesHoweverLittleFollows) {
  const TempFolder folder;
  const std::string hdf5 = "\x89HDF\r\n\x1a\n", zip = "PK\x03\x04";
  for (const char* rest : {"", "more"}) {
    const auto grids = folder.Write("a.txt", hdf5 + rest), archive = folder.Write("b", zip + rest);
    EXPECT_TRUE(IsHdf5(grids));
    EXPECT_FALSE(IsZip(grids));
    EXPECT_TRUE(IsZip(archive));
    EXPECT_FALSE(IsHdf5(archive));
  }
}

TEST(FileKind, OfWhatEndsBeforeIsNoFileOrDoesNotExistIsNone) {
  const TempFolder folder;
  for (const auto& path : {folder.Write("a.h5", "\x89HDF\r\n\x1a"), folder.Write("a.pt", "PK\x03"),
                           folder.Write("empty", ""), folder.path(), folder / "none"}) {
    EXPECT_FALSE(IsHdf5(path)) << path;
    EXPECT_FALSE(IsZip(path)) << path;
  }
}

// An STL of one face: 80 bytes of header, the count, 50 bytes.
std::string BinaryStl() {
  std::string bytes(80 + 4 + 50, '\0');
  bytes[80] = 1;
  return bytes;
}

const std::vector<std::pair<std::string, FileKind>> kKinds{
    {"\x89HDF\r\n\x1a\n", FileKind::kHdf5},
    {"PK\x03\x04", FileKind::kZip},
    {"\x89PNG\r\n\x1a\n", FileKind::kPng},
    {"object,status\nmug.stl,ok\n", FileKind::kTable},
    {"id, p1x ,p1y\r\n", FileKind::kTable},
    {BinaryStl(), FileKind::kMesh},
    {"solid mug\n  facet normal 0 0 1\n", FileKind::kMesh},
    {"ply\nformat ascii 1.0\n", FileKind::kMesh},
    {"OFF\n4 4 0\n", FileKind::kMesh},
    {"# of a scanner\n\nmtllib a.mtl\n", FileKind::kMesh},
    {"v 0 0 1\n", FileKind::kMesh},
    // Settings, a sentence, numbers without names, a header that does not end, one name.
    {"[gan]\nbatch = 3\n", FileKind::kUnknown},
    {"v = 3\n", FileKind::kUnknown},
    {"solid, said he\n", FileKind::kUnknown},
    {"1,2,3\n", FileKind::kUnknown},
    {"object,status", FileKind::kUnknown},
    {"object\nmug\n", FileKind::kUnknown},
    {BinaryStl() + "x", FileKind::kUnknown},
    {"", FileKind::kUnknown}};

TEST(FileKind, OfTextIsSaidByItsFirstLinesWhateverItIsCalled) {
  const TempFolder folder;
  for (const auto& [bytes, kind] : kKinds) {
    EXPECT_EQ(KindOf(folder.Write("file", bytes)), kind) << bytes;
  }
  EXPECT_EQ(KindOf(folder.path()), FileKind::kUnknown);
  EXPECT_EQ(KindOf(folder / "none"), FileKind::kUnknown);
}

TEST(FileKind, AnotherKindThanTheOneWantedIsNamedInALine) {
  const TempFolder folder;
  const auto why = [&](const std::string& bytes, FileKind wanted) -> std::string {
    try {
      RefuseOtherKind(folder.Write("file", bytes), wanted, "a thing", "a better one");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string end =
      ", not a thing (" + (folder / "file").string() + "): expected a better one";
  EXPECT_EQ(why("a,b,c,d\n", FileKind::kMesh), "is a table of a, b, c, d" + end);
  EXPECT_EQ(why("a,b,c,d,e\n", FileKind::kMesh), "is a table of a, b, c, d, ..." + end);
  EXPECT_EQ(why("OFF\n", FileKind::kTable), "is a mesh" + end);
  EXPECT_EQ(why(kKinds[0].first, FileKind::kMesh), "is an HDF5 file (as SDF files are)" + end);
  EXPECT_EQ(why(kKinds[1].first, FileKind::kMesh), "is a zip archive (as checkpoints are)" + end);
  EXPECT_EQ(why(kKinds[2].first, FileKind::kMesh), "is a picture" + end);
  for (const auto& [bytes, kind] : kKinds) {
    EXPECT_EQ(why(bytes, kind), "");
    EXPECT_EQ(why(bytes, FileKind::kUnknown).empty(), kind == FileKind::kUnknown) << bytes;
  }
}

}  // namespace
}  // namespace antigrasp
