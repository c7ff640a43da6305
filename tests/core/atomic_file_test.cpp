#include "antigrasp/core/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

int FilesIn(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(AtomicFile, LeavesTheOldFileWhenNotCommitted) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt";
  WriteFileAtomic(target, "old");
  {
    const AtomicFile file(target);
    std::ofstream(file.temp_path()) << "half-writ";
  }
  EXPECT_EQ(ReadFile(target), "old");
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

TEST(AtomicFile, ReplacesTheOldFileWhenCommitted) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt";
  WriteFileAtomic(target, "old");
  WriteFileAtomic(target, std::string("new\0bytes", 9));
  EXPECT_EQ(ReadFile(target), std::string("new\0bytes", 9));
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

TEST(AtomicFile, AFullDiskKeepsTheOldFileAndSaysSo) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt";
  WriteFileAtomic(target, "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit tight = before;
  tight.rlim_cur = 1000;
  setrlimit(RLIMIT_FSIZE, &tight);
  EXPECT_THROW(WriteFileAtomic(target, std::string(100000, 'x')), RuntimeFailure);
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(ReadFile(target), "old");
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

TEST(AtomicFile, RefusesAMissingFolderAndAFolderAsTarget) {
  const shapes::TempFolder folder;
  EXPECT_THROW(WriteFileAtomic(folder.path() / "no" / "a.txt", "x"), InputError);
  EXPECT_THROW(WriteFileAtomic(folder.path(), "x"), InputError);
}

TEST(ReadFile, SaysWhatIsWrongWithThePath) {
  const shapes::TempFolder folder;
  EXPECT_THROW(ReadFile(folder.path() / "missing"), InputError);
  EXPECT_THROW(ReadFile(folder.path()), InputError);
}

TEST(MakeFolder, RefusesAFileInTheWay) {
  const shapes::TempFolder folder;
  WriteFileAtomic(folder.path() / "file", "x");
  EXPECT_THROW(MakeFolder(folder.path() / "file"), InputError);
  EXPECT_THROW(MakeFolder(folder.path() / "file" / "sub"), InputError);
  MakeFolder(folder.path() / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
}

}  // namespace
}  // namespace antigrasp
