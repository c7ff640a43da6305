// The control of a run while the run goes on.
#include "antigrasp/train/control_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/cem_run.h"
#include "antigrasp/train/run_lock.h"
#include "tests/support/child_process.h"
#include "tests/support/temp_folder.h"
#include "tests/train/run_files.h"
#include "tests/train/sphere_model.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::ChildProcess;
using shapes::ExpectSameFiles;
using shapes::MakeSpheres;
using shapes::StoppingObserver;
using shapes::TempFolder;
using shapes::Tiny;

RunConfig WithControl() {
  RunConfig config = Tiny();
  config.cem.control = true;
  config.cem.episodes = 1;
  return config;
}

// Does what another process would at once: `work` in the folder of the control.
class DoneAtOnce : public RunBeside {
 public:
  explicit DoneAtOnce(const std::function<void()>& work) { work(); }
  bool Ended() override { return true; }
  std::string WhyEnded() const override { return "signal 9 (Killed)"; }
};

RunParts Beside(const std::function<void(const fs::path&)>& work) {
  RunParts parts;
  parts.run_beside = [work](const fs::path& folder) {
    return std::make_unique<DoneAtOnce>([&] { work(folder); });
  };
  return parts;
}

TEST(ControlRun, HasTheSameBytesBesideTheRunHalfDoneAndAfterIt) {
  const TempFolder folder;
  StoppingObserver never;
  const RunConfig config = WithControl();
  const RunResult after = StartRun(config, folder / "after", &never, MakeSpheres);
  const RunResult beside =
      StartRun(config, folder / "beside", &never, MakeSpheres,
               Beside([&](const fs::path& control) { ResumeRun(control, &never, MakeSpheres); }));
  StartRun(config, folder / "half", &never, MakeSpheres, Beside([&](const fs::path& control) {
             StoppingObserver stopping(12);
             EXPECT_THROW(ResumeRun(control, &stopping, MakeSpheres), Interrupted);
           }));
  ExpectSameFiles(folder / "after", folder / "beside");
  ExpectSameFiles(folder / "after", folder / "half");
  ASSERT_EQ(after.control.size(), 3U);  // prior, 0, 1
  ASSERT_EQ(beside.control.size(), after.control.size());
  EXPECT_EQ(beside.control[2].graspability.mean, after.control[2].graspability.mean);
}

TEST(ControlRun, IsHandedOverOnceWhenEpisode0IsTrainedAndBeforeItIsScored) {
  const TempFolder folder;
  StoppingObserver never;
  int asked = 0;
  StartRun(WithControl(), folder / "run", &never, MakeSpheres, Beside([&](const fs::path& control) {
             ++asked;
             EXPECT_EQ(control, folder / "run/control");
             EXPECT_TRUE(fs::exists(folder / "run/episode_0/checkpoint.pt"));
             EXPECT_FALSE(fs::exists(folder / "run/episode_0/scores.csv"));
           }));
  EXPECT_EQ(asked, 1);
}

// Counts how often somebody asks for another process.
class Asked {
 public:
  BesideStarter Starter() {
    return [this](const fs::path&) -> std::unique_ptr<RunBeside> {
      ++times_;
      return nullptr;
    };
  }
  int times() const { return times_; }

 private:
  int times_ = 0;
};

// A run whose control has begun.
RunFolder Begun(const TempFolder& folder, const RunConfig& config) {
  const RunFolder run{folder.path()};
  fs::create_directory(run.Control());
  WriteFileAtomic(RunFolder{run.Control()}.Config(), ToToml(config));
  return run;
}

int TimesAsked(const RunConfig& config) {
  const TempFolder folder;
  const RunFolder run = Begun(folder, config);
  Asked asked;
  const BesideStarter starter = asked.Starter();
  ControlRun(config, run, starter).BeginBeside();
  return asked.times();
}

// A machine without room for another process.
TEST(ControlRun, ThatNoProcessCanBeStartedForComesAfterTheRun) {
  const TempFolder folder;
  StoppingObserver never;
  RunParts parts;
  parts.run_beside = [](const fs::path&) -> std::unique_ptr<RunBeside> {
    throw RuntimeFailure("no room");
  };
  StartRun(WithControl(), folder / "refused", &never, MakeSpheres, parts);
  StartRun(WithControl(), folder / "after", &never, MakeSpheres);
  ExpectSameFiles(folder / "after", folder / "refused");
}

TEST(ControlRun, IsNotHandedOverWithOneThreadOnAGpuWithAProgramThatScoresOrWhereItIsNotWanted) {
  EXPECT_EQ(TimesAsked(WithControl()), 1);
  RunConfig config = WithControl();
  config.threads = 1;
  EXPECT_EQ(TimesAsked(config), 0);
  config = WithControl();
  config.cem.control = false;
  EXPECT_EQ(TimesAsked(config), 0);
  config = WithControl();
  config.cem.score = "judge:anything";
  EXPECT_EQ(TimesAsked(config), 0);
  config = WithControl();
  config.device = "cuda";
  EXPECT_EQ(TimesAsked(config), 0);
}

// A process that goes on with the control of a run that was killed may still be there.
TEST(ControlRun, ThatAnotherProcessTrainsStillIsLeftForLater) {
  const TempFolder folder;
  const RunConfig config = WithControl();
  const RunFolder run = Begun(folder, config);
  ChildProcess other([&] { new RunLock(RunFolder{run.Control()}); });
  ASSERT_TRUE(other.alive());
  Asked asked;
  const BesideStarter starter = asked.Starter();
  ControlRun control(config, run, starter);
  EXPECT_FALSE(control.BeginBeside());
  EXPECT_EQ(asked.times(), 0);
  other.Kill();
  EXPECT_TRUE(control.BeginBeside());
  EXPECT_EQ(asked.times(), 1);
}

TEST(ControlRun, OfARunThatIsDeletedMustNotBeTrainedByAnother) {
  const TempFolder folder;
  const RunFolder run = Begun(folder, WithControl());
  WriteFileAtomic(run.Config(), ToToml(WithControl()));
  ChildProcess other([&] { new RunLock(RunFolder{run.Control()}); });
  ASSERT_TRUE(other.alive());
  EXPECT_THROW(run.Remove(), InputError);
  EXPECT_TRUE(run.HoldsARun());
  other.Kill();
  run.Remove();
  EXPECT_FALSE(fs::exists(run.Control()));
}

}  // namespace
}  // namespace antigrasp
