#include "antigrasp/core/file_kind.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace antigrasp
