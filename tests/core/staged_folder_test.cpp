#include "antigrasp/core/staged_folder.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/child_process.h"
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

TEST(StagedFolder, ItsFoldersAreFilledUpAndWhatOthersHaveThereStays) {
  const TempFolder folder;
  folder.Write("after/a", "old");
  folder.Write("after/mine", "mine");
  StagedFolder staged(folder.path());
  fs::create_directories(staged.path() / "after/deep");
  fs::create_directories(staged.path() / "before");
  WriteFileAtomic(staged.path() / "after/a", "new");
  WriteFileAtomic(staged.path() / "after/deep/b", "other");
  staged.Commit();
  EXPECT_EQ(ReadFile(folder / "after/a"), "new");
  EXPECT_EQ(ReadFile(folder / "after/mine"), "mine");
  EXPECT_EQ(ReadFile(folder / "after/deep/b"), "other");
  EXPECT_TRUE(fs::is_directory(folder / "before"));
}

TEST(StagedFolder, WhatIsToComeLastDoesNotComeBeforeAllElseIsThere) {
  for (const char* last : {"a", "c"}) {
    const TempFolder folder;
    fs::create_directories(folder / "b/in the way");
    StagedFolder staged(folder.path());
    for (const char* name : {"a", "b", "c"}) WriteFileAtomic(staged.path() / name, "new");
    EXPECT_THROW(staged.Commit(last), RuntimeFailure);
    EXPECT_FALSE(fs::exists(folder / last)) << last;
    fs::remove_all(folder / "b");
    WriteFileAtomic(staged.path() / "b", "new");
    staged.Commit(last);
    EXPECT_EQ(ReadFile(folder / last), "new");
  }
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

TEST(StagedFolder, WhatAKilledProcessStagedGoesWithTheNextAndWhatALivingOneStagesStays) {
  const TempFolder folder;
  folder.Write(".antigrasp-x.tmp/mine", "no number: not ours");
  const auto stage = [&](const std::string& name) {
    return [&folder, name] {
      auto* const staged = new StagedFolder(folder.path());  // as a killed process leaves it
      WriteFileAtomic(staged->path() / name, "half of the work");
    };
  };
  const auto holds = [&](const std::string& name) {
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      if (fs::exists(entry.path() / name)) return true;
    }
    return false;
  };
  shapes::ChildProcess killed(stage("killed")), living(stage("living"));
  ASSERT_TRUE(killed.alive() && living.alive());
  killed.Kill();
  ASSERT_TRUE(holds("killed") && holds("living"));
  StagedFolder next(folder.path());
  EXPECT_FALSE(holds("killed"));
  EXPECT_TRUE(holds("living"));
  EXPECT_TRUE(holds("mine"));
  WriteFileAtomic(next.path() / "a", "new");
  next.Commit();
  EXPECT_EQ(ReadFile(folder / "a"), "new");
  EXPECT_FALSE(fs::exists(folder / ".lock"));
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
