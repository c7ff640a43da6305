#include "antigrasp/core/staged_folder.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::TempFolder;

TEST(StagedFolder, ItsFilesAppearTogetherAndTakeThePlaceOfOlderOnes) {
  const TempFolder folder;
  folder.Write("a", "old");
  StagedFolder staged(folder.path());
  WriteFileAtomic(staged.path() / "a", "new");
  WriteFileAtomic(staged.path() / "b", "other");
  EXPECT_EQ(ReadFile(folder / "a"), "old");
  EXPECT_FALSE(fs::exists(folder / "b"));
  staged.Commit();
  EXPECT_EQ(ReadFile(folder / "a"), "new");
  EXPECT_EQ(ReadFile(folder / "b"), "other");
}

TEST(StagedFolder, WithoutCommitTheFolderIsAsItWas) {
  const TempFolder folder;
  folder.Write("a", "old");
  for (const fs::path& path : {folder.path(), folder / "deep/made"}) {
    StagedFolder staged(path);
    WriteFileAtomic(staged.path() / "a", "new");
  }
  EXPECT_EQ(ReadFile(folder / "a"), "old");
  EXPECT_FALSE(fs::exists(folder / "deep/made"));
  { StagedFolder(folder / "made").Commit(); }
  EXPECT_FALSE(fs::exists(folder / "made")) << "nothing came of it";
  int left = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    left += entry.path().filename().string().starts_with(".") ? 1 : 0;
  }
  EXPECT_EQ(left, 0);
  EXPECT_THROW(StagedFolder(folder / "a"), InputError);
}

TEST(StagedFolder, AnObstacleInTheWayIsNamed) {
  const TempFolder folder;
  fs::create_directories(folder / "a/in the way");
  StagedFolder staged(folder.path());
  WriteFileAtomic(staged.path() / "a", "new");
  EXPECT_THROW(staged.Commit(), RuntimeFailure);
}

}  // namespace
}  // namespace antigrasp
