#include "antigrasp/core/background_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "antigrasp/core/atomic_file.h"
#include "tests/support/child_process.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::ChildProcess;
using shapes::TempFolder;

bool Soon(const std::function<bool()>& true_of) {
  for (int i = 0; i < 2000 && !true_of(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true_of();
}

// A shell that makes file "begun", works until it is told to stop and then makes "stopped".
std::vector<std::string> Works(const TempFolder& folder) {
  const std::string here = folder.path().string();
  return {"sh", "-c",
          "trap 'touch " + here + "/stopped; exit' TERM; touch " + here +
              "/begun; while :; do sleep 0.01; done"};
}

TEST(BackgroundProcess, IsToldToStopWhenItsObjectGoesWhichWaitsForIt) {
  const TempFolder folder;
  {
    BackgroundProcess process("/bin/sh", Works(folder));
    ASSERT_TRUE(Soon([&] { return fs::exists(folder / "begun"); }));
    EXPECT_FALSE(process.Ended());
    EXPECT_FALSE(fs::exists(folder / "stopped"));
  }
  EXPECT_TRUE(fs::exists(folder / "stopped"));
}

TEST(BackgroundProcess, IsToldToStopWhenItsMakerIsKilled) {
  const TempFolder folder;
  ChildProcess maker([&] { new BackgroundProcess("/bin/sh", Works(folder)); });
  ASSERT_TRUE(maker.alive());
  ASSERT_TRUE(Soon([&] { return fs::exists(folder / "begun"); }));
  maker.Kill();
  EXPECT_TRUE(Soon([&] { return fs::exists(folder / "stopped"); }));
}

TEST(BackgroundProcess, HasAGroupOfItsOwnSoThatCtrlCIsNotItsOwn) {
  const TempFolder folder;
  const std::string file = (folder / "group").string();
  BackgroundProcess process(
      "/bin/sh", {"sh", "-c",
                  "cut -d' ' -f5 /proc/$$/stat > " + file + ".part; mv " + file + ".part " + file});
  ASSERT_TRUE(Soon([&] { return process.Ended(); }));
  EXPECT_NE(std::stoi(ReadFile(file)), static_cast<int>(getpgrp()));
}

TEST(BackgroundProcess, HasEndedWhereTheProgramIsNotThere) {
  BackgroundProcess process("/no/such/program", {"program"});
  EXPECT_TRUE(Soon([&] { return process.Ended(); }));
  EXPECT_EQ(process.end().code, 127);
}

TEST(BackgroundProcess, SaysHowItEnded) {
  BackgroundProcess fails("/bin/sh", {"sh", "-c", "exit 3"});
  BackgroundProcess killed("/bin/sh", {"sh", "-c", "kill -KILL $$"});
  ASSERT_TRUE(Soon([&] { return fails.Ended() && killed.Ended(); }));
  EXPECT_EQ(fails.end().text, "exit code 3");
  EXPECT_TRUE(killed.end().text.starts_with("signal 9")) << killed.end().text;
}

TEST(BackgroundProcess, HasNoneOfTheFilesThatAreOpenHere) {
  const TempFolder folder;
  const std::string list = (folder / "list").string();
  const int high = ::fcntl(STDERR_FILENO, F_DUPFD, 77);
  ASSERT_GE(high, 77);
  BackgroundProcess process("/bin/sh", {"sh", "-c", "ls /proc/$$/fd > " + list});
  ASSERT_TRUE(Soon([&] { return process.Ended(); }));
  ::close(high);
  const std::string files = "\n" + ReadFile(list);
  EXPECT_NE(files.find("\n0\n"), std::string::npos) << files;
  EXPECT_EQ(files.find("\n" + std::to_string(high) + "\n"), std::string::npos) << files;
}

}  // namespace
}  // namespace antigrasp
