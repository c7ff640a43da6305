#include "antigrasp/core/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

int FilesIn(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), {}));
}

std::string Refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(AtomicFile, RefusesWhatIsNoFileAndLeavesItThere) {
  const shapes::TempFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_NE(Refusal([&] { WriteFileAtomic(pipe, "bytes"); }).find("not a device, pipe or socket"),
            std::string::npos);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(FilesIn(folder.path()), 1);
  EXPECT_NE(Refusal([&] { WriteFileAtomic("/dev/null", "bytes"); }), "no error");
}

TEST(AtomicFile, WritesWhereALinkLeadsTo) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt", link = folder.path() / "link";
  WriteFileAtomic(target, "old");
  fs::create_symlink("a.txt", link);
  WriteFileAtomic(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  std::ifstream file(target);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "new");
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
  const std::string nowhere = folder.path() / "no" / "a.txt", itself = folder.path();
  EXPECT_EQ(Refusal([&] { WriteFileAtomic(nowhere, "x"); }),
            "cannot write " + nowhere + " (" + itself +
                "/no): expected an existing folder to write into");
  EXPECT_EQ(Refusal([&] { WriteFileAtomic(itself, "x"); }),
            "cannot write " + itself + " (" + itself + "): expected a file name, not a folder");
  EXPECT_EQ(FilesIn(folder.path()), 0);
}

TEST(ReadFile, SaysWhatIsWrongWithThePath) {
  const shapes::TempFolder folder;
  const std::string missing = folder.path() / "missing";
  EXPECT_EQ(Refusal([&] { ReadFile(missing); }),
            "no such file (" + missing + "): expected a readable file");
  EXPECT_EQ(Refusal([&] { ReadFile(folder.path()); }),
            "is a folder (" + folder.path().string() + "): expected a readable file");
  EXPECT_EQ(Refusal([&] { RequireFile("/dev/null", "a picture"); }),
            "not a file (/dev/null): expected a picture");
}

TEST(AtomicFile, ATemporaryNameIsHiddenBesideItsTarget) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt";
  const fs::path temporary = AtomicFile(target).temp_path();
  EXPECT_EQ(temporary.parent_path(), folder.path());  // a rename across disks would fail
  EXPECT_TRUE(temporary.filename().string().starts_with(".a.txt."));
  EXPECT_NE(AtomicFile(folder.path() / "b.txt").temp_path(), temporary);
}

TEST(AtomicFile, WhatACrashLeftUnderTheTemporaryNameIsNotKept) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt";
  const fs::path temporary = AtomicFile(target).temp_path();
  std::ofstream(temporary) << "left over, and longer";
  ASSERT_TRUE(fs::exists(temporary));
  WriteFileAtomic(target, "new");
  EXPECT_EQ(ReadFile(target), "new");
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

TEST(AtomicFile, TwoWritersOfOneFileHaveTwoTemporaryOnes) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / "a.txt";
  {
    AtomicFile first(target), second(target);
    EXPECT_EQ(first.temp_path().filename(), ".a.txt.antigrasp.tmp");
    EXPECT_EQ(second.temp_path().filename(), ".a.txt.antigrasp-2.tmp");
    std::ofstream(first.temp_path()) << "first";
    std::ofstream(second.temp_path()) << "second";
    first.Commit();
    EXPECT_EQ(ReadFile(target), "first");
    second.Commit();
  }
  EXPECT_EQ(ReadFile(target), "second");
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

// A name may have 255 bytes.
TEST(AtomicFile, LongNamesHaveATemporaryOneToo) {
  const shapes::TempFolder folder;
  const fs::path target = folder.path() / std::string(255, 'n');
  WriteFileAtomic(target, "new");
  EXPECT_EQ(ReadFile(target), "new");
}

TEST(AtomicFile, ANameWithoutAFolderIsInTheWorkingFolder) {
  const shapes::TempFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  WriteFileAtomic("a.txt", "here");
  fs::current_path(before);
  EXPECT_EQ(ReadFile(folder.path() / "a.txt"), "here");
}

TEST(AtomicFile, WhatIsAppendedIsThereAfterCommitAlone) {
  const shapes::TempFolder folder;
  {
    AtomicFile file(folder / "a.txt");
    file.Append("one ");
    file.Append("two");
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
    file.Commit();
    AtomicFile other(folder / "b.txt");
    other.Append("lost");
  }
  EXPECT_EQ(ReadFile(folder / "a.txt"), "one two");
  EXPECT_EQ(FilesIn(folder.path()), 1);
}

TEST(RequireApart, RefusesTwoWaysToNameOneFile) {
  const shapes::TempFolder folder;
  fs::create_directory(folder / "sub");
  RequireApart({folder / "a", folder / "b", "", ""});
  EXPECT_THROW(RequireApart({folder / "a", folder / "b", folder / "a"}), InputError);
  EXPECT_THROW(RequireApart({folder / "a", folder / "sub/../a"}), InputError);
  EXPECT_THROW(RequireApart({"not-there-yet", fs::current_path() / "not-there-yet"}), InputError);
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
