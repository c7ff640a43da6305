// One process at a time trains a run, and what a killed one leaves goes with the next.
#include "antigrasp/train/run_lock.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/cem_run.h"
#include "tests/support/child_process.h"
#include "tests/support/temp_folder.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::ChildProcess;
using shapes::StoppingObserver;
using shapes::TempFolder;
using shapes::Tiny;

std::string Refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(RunLock, OfAnotherProcessKeepsEveryWayIntoTheRunShut) {
  const TempFolder folder;
  StoppingObserver observer;
  const RunFolder run{folder / "run"}, fresh{folder / "fresh"};
  fs::create_directory(run.root);
  WriteFileAtomic(run.Config(), ToToml(Tiny()));
  ChildProcess other([&] {
    new RunLock(run);
    new RunLock(fresh);
  });
  ASSERT_TRUE(other.alive());
  const std::string by = "process " + std::to_string(other.pid()) + " on ";
  for (const auto& way : std::vector<std::function<void()>>{
           [&] { ResumeRun(run.root, &observer); }, [&] { run.Remove(); },
           [&] { StartRun(Tiny(), fresh.root, &observer); }}) {
    const std::string text = Refusal(way);
    EXPECT_TRUE(text.starts_with(by)) << text;
    EXPECT_NE(text.find(" trains this run (" + folder.path().string()), std::string::npos) << text;
  }
  EXPECT_TRUE(run.HoldsARun());
  other.Kill();
  EXPECT_EQ(Refusal([&] { run.Remove(); }), "not refused");
  EXPECT_EQ(Refusal([&] { const RunLock lock(fresh); }), "not refused");
}

TEST(RunLock, LeavesNoFolderThatNothingWasWrittenTo) {
  const TempFolder folder;
  const RunFolder run{folder / "run"};
  { const RunLock lock(run); }
  EXPECT_FALSE(fs::exists(run.root));
  {
    const RunLock lock(run);
    WriteFileAtomic(run.Config(), "bytes");
  }
  { const RunLock lock(run); }
  EXPECT_EQ(std::distance(fs::directory_iterator(run.root), {}), 1);
}

TEST(RunLock, RemovesWhatKilledWritersOfTheRunLeft) {
  const TempFolder folder;
  const RunFolder run{folder / "run"};
  const fs::path mine = run.root / "notes/.a.antigrasp.tmp", thesis = run.root / ".thesis.tmp";
  const std::vector<fs::path> targets = {run.Latest(), run.EpisodeCheckpoint(0),
                                         run.EpisodeCheckpoint(12), run.Stl() / "a.stl",
                                         run.Events().parent_path() / "x"};
  for (const fs::path& target : targets) fs::create_directories(target.parent_path());
  ChildProcess writer([&] {
    for (const fs::path& target : targets) new AtomicFile(target);
  });
  ASSERT_TRUE(writer.alive());
  folder.Write("run/notes/.a.antigrasp.tmp", "not the run's");
  folder.Write("run/.thesis.tmp", "not ours");
  const auto files = [&] {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(run.root)) {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  };
  { const RunLock lock(run); }
  EXPECT_EQ(files(), 7);  // the writer lives
  writer.Kill();
  { const RunLock lock(run); }
  EXPECT_EQ(files(), 2);
  EXPECT_TRUE(fs::exists(mine));
  EXPECT_TRUE(fs::exists(thesis));
}

}  // namespace
}  // namespace antigrasp
