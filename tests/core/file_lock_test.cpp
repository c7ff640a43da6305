// Locks between processes that really are some, and that are really killed.
#include "antigrasp/core/file_lock.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/folder_lock.h"
#include "tests/support/child_process.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::ChildProcess;
using shapes::TempFolder;
using State = FileLock::State;

TEST(FileLock, IsOnePlaceAtATime) {
  const TempFolder folder;
  auto first = std::make_unique<FileLock>(folder / "lock");
  EXPECT_EQ(first->state(), State::kHeld);
  EXPECT_EQ(FileLock(folder / "lock").state(), State::kTaken);
  EXPECT_EQ(FileLock(folder / "other").state(), State::kHeld);
  first.reset();
  EXPECT_EQ(FileLock(folder / "lock").state(), State::kHeld);
}

TEST(FileLock, OfAKilledProcessBlocksNobody) {
  const TempFolder folder;
  ChildProcess holder([&] { new FileLock(folder / "lock"); });
  ASSERT_TRUE(holder.alive());
  EXPECT_EQ(FileLock(folder / "lock").state(), State::kTaken);
  holder.Kill();
  EXPECT_TRUE(fs::exists(folder / "lock"));
  EXPECT_EQ(FileLock(folder / "lock").state(), State::kHeld);
}

TEST(FileLock, CreatesAFileOnlyWhenItMay) {
  const TempFolder folder;
  EXPECT_EQ(FileLock(folder / "lock", FileLock::Missing::kLeave).state(), State::kNone);
  EXPECT_EQ(FileLock(folder / "no/lock").state(), State::kNone);
  EXPECT_EQ(shapes::CountFiles(folder.path()), 0);
}

TEST(FileLock, DoesNotFollowALinkToAnotherFile) {
  const TempFolder folder;
  folder.Write("precious", "text");
  fs::create_symlink(folder / "precious", folder / "lock");
  EXPECT_EQ(FileLock(folder / "lock").state(), State::kNone);
}

std::string Refusal(const fs::path& folder) {
  try {
    const FolderLock lock(folder, "works here");
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(FolderLock, NamesTheProcessAndItsComputer) {
  const TempFolder folder;
  ChildProcess holder([&] { new FolderLock(folder.path(), "works here"); });
  ASSERT_TRUE(holder.alive());
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  EXPECT_EQ(Refusal(folder.path()),
            "process " + std::to_string(holder.pid()) + " on " + host.data() + " works here (" +
                folder.path().string() +
                "): expected one process at a time: wait for it or stop it");
  holder.Kill();
  EXPECT_EQ(Refusal(folder.path()), "not refused");
}

TEST(FolderLock, LeavesNothing) {
  const TempFolder folder;
  {
    const FolderLock lock(folder.path(), "works here");
    EXPECT_TRUE(lock.held());
    EXPECT_EQ(ReadFile(folder / ".lock").substr(0, 8), "process ");
  }
  EXPECT_EQ(shapes::CountFiles(folder.path()), 0);
}

// The line of one who was killed is not in front of, or behind, that of the next.
TEST(FolderLock, SaysTheNewHolderOnly) {
  const TempFolder folder;
  folder.Write(".lock", "process 123456789012345 on a computer with a long name\n");
  const FolderLock lock(folder.path(), "works here");
  const std::string line = ReadFile(folder / ".lock");
  EXPECT_TRUE(line.starts_with("process " + std::to_string(getpid()) + " on ")) << line;
  EXPECT_EQ(line.find("123456789012345"), std::string::npos);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
}

// A process that has a temporary file of `target` open, half written.
void HalfWrite(const fs::path& target) {
  const auto* const file = new AtomicFile(target);
  std::ofstream(file->temp_path()) << "half a checkpo";
}

TEST(AbandonedFiles, AreRemovedOnceTheirWriterIsDead) {
  const TempFolder folder;
  ChildProcess writer([&] { HalfWrite(folder / "a.pt"); });
  ASSERT_TRUE(writer.alive());
  EXPECT_EQ(RemoveAbandonedFiles(folder.path()), 0);
  EXPECT_EQ(shapes::CountFiles(folder.path()), 1);
  writer.Kill();
  EXPECT_EQ(shapes::CountFiles(folder.path()), 1);
  EXPECT_EQ(RemoveAbandonedFiles(folder.path()), 1);
  EXPECT_EQ(shapes::CountFiles(folder.path()), 0);
}

TEST(AbandonedFiles, AreTakenOverByTheNextWriterOfTheSameFile) {
  const TempFolder folder;
  ChildProcess writer([&] { HalfWrite(folder / "a.pt"); });
  writer.Kill();
  ASSERT_EQ(shapes::CountFiles(folder.path()), 1);
  {
    const AtomicFile next(folder / "a.pt");
    EXPECT_EQ(ReadFile(next.temp_path()), "");  // also for one who appends
  }
  EXPECT_EQ(shapes::CountFiles(folder.path()), 0);
}

TEST(AbandonedFiles, AreNotTakenFromALivingWriter) {
  const TempFolder folder;
  ChildProcess writer([&] { HalfWrite(folder / "a.pt"); });
  WriteFileAtomic(folder / "a.pt", "whole");
  EXPECT_EQ(ReadFile(folder / "a.pt"), "whole");
  EXPECT_EQ(ReadFile(folder / ".a.pt.antigrasp.tmp"), "half a checkpo");
  EXPECT_EQ(shapes::CountFiles(folder.path()), 2);
}

TEST(AbandonedFiles, AreNobodyElses) {
  const TempFolder folder;
  const std::vector<std::string> others = {"a.antigrasp.tmp",      ".a.tmp",
                                           ".a.123.tmp",           ".antigrasp.tmp",
                                           ".a.antigrasp",         ".a.antigrasp-x.tmp",
                                           ".a.antigrasp.tmp.txt", ".a.Antigrasp.tmp"};
  for (const std::string& name : others) folder.Write(name, "theirs");
  folder.Write("precious", "text");
  fs::create_symlink(folder / "precious", folder / ".link.antigrasp.tmp");
  fs::create_directory(folder / ".folder.antigrasp.tmp");
  folder.Write(".folder.antigrasp.tmp/.a.antigrasp.tmp", "in a folder");
  EXPECT_EQ(RemoveAbandonedFiles(folder.path()), 0);
  for (const char* name : {".a.antigrasp.tmp", ".b c.pt.antigrasp-2.tmp", ".d.antigrasp-p77.tmp"}) {
    folder.Write(name, "ours");
  }
  EXPECT_EQ(RemoveAbandonedFiles(folder.path()), 3);
  EXPECT_EQ(shapes::CountFiles(folder.path()),
            static_cast<int>(others.size()) + 4);  // the link and the folder too
  EXPECT_EQ(RemoveAbandonedFiles(folder / "missing"), 0);
}

}  // namespace
}  // namespace antigrasp
