#include "antigrasp/train/provenance.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/version.h"
#include "antigrasp/train/cem_run.h"
#include "tests/support/temp_folder.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::StoppingObserver;
using shapes::TempFolder;

RunConfig Short() {
  RunConfig config = shapes::Tiny();
  config.cem.episodes = 0;
  return config;
}

TEST(Provenance, SaysWhatMadeTheRunAndAddsUpTheWorkOfAllResumptions) {
  const TempFolder folder;
  const RunFolder run{folder / "run"};
  StoppingObserver stopping(8 + 4 + 5);  // in training
  EXPECT_THROW(StartRun(Short(), run.root, &stopping), Interrupted);
  const auto begun = ReadProvenance(run);
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->version, ProgramVersion());
  EXPECT_EQ(begun->commit, ProgramCommit());
  EXPECT_NE(begun->libtorch, "");
  EXPECT_EQ(begun->device, "cpu");
  EXPECT_EQ(begun->threads, 2);
  EXPECT_EQ(begun->torch_threads, 1);
  EXPECT_TRUE(begun->started.ends_with(" UTC")) << begun->started;
  EXPECT_EQ(begun->finished, "");
  EXPECT_GT(begun->seconds, 0.0);

  StoppingObserver never;
  ResumeRun(run.root, &never);
  const auto finished = ReadProvenance(run);
  EXPECT_EQ(finished->started, begun->started);
  EXPECT_NE(finished->finished, "");
  EXPECT_GT(finished->seconds, begun->seconds);

  const std::string bytes = ReadFile(run.Provenance());
  ResumeRun(run.root, &never);  // only reports its numbers
  EXPECT_EQ(ReadFile(run.Provenance()), bytes);
}

TEST(Provenance, IsNotInventedForARunThatWasBegunWithoutIt) {
  const TempFolder folder;
  const RunFolder run{folder / "run"};
  StoppingObserver stopping(8 + 4 + 5), never;
  EXPECT_THROW(StartRun(Short(), run.root, &stopping), Interrupted);
  fs::remove(run.Provenance());
  ResumeRun(run.root, &never);
  EXPECT_FALSE(ReadProvenance(run));
}

TEST(Provenance, IsReadByTheNamesOfItsKeys) {
  const TempFolder folder;
  folder.Write("provenance.toml",
               "[provenance]\nversion = \"1.2\"\ncommit = \"abc\"\nlibtorch = \"1.13.0\"\n"
               "device = \"cuda:1\"\ncpu = \"a processor\"\nthreads = 3\ntorch_threads = 4\n"
               "started = \"in the morning\"\nfinished = \"at night\"\nseconds = 5.5\n");
  const auto read = ReadProvenance(RunFolder{folder.path()});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->version, "1.2");
  EXPECT_EQ(read->commit, "abc");
  EXPECT_EQ(read->libtorch, "1.13.0");
  EXPECT_EQ(read->device, "cuda:1");
  EXPECT_EQ(read->cpu, "a processor");
  EXPECT_EQ(read->threads, 3);
  EXPECT_EQ(read->torch_threads, 4);
  EXPECT_EQ(read->started, "in the morning");
  EXPECT_EQ(read->finished, "at night");
  EXPECT_EQ(read->seconds, 5.5);
}

TEST(Provenance, TakesLibTorchsThreadsFromTheOthersOnlyWhereNoneAreAskedFor) {
  RunConfig config;
  config.threads = 3;
  config.torch_threads = 2;
  config.device = "cuda:1";
  EXPECT_EQ(ProvenanceNow(config).threads, 3);
  EXPECT_EQ(ProvenanceNow(config).torch_threads, 2);
  EXPECT_EQ(ProvenanceNow(config).device, "cuda:1");
  config.torch_threads = 0;
  EXPECT_EQ(ProvenanceNow(config).torch_threads, 3);
}

// A run half done: only the seconds of its work so far matter here.
TEST(Provenance, AddsToTheSecondsOfBeforeAndLeavesAFinishedRunsAlone) {
  const TempFolder folder;
  const RunFolder run{folder.path()};
  folder.Write("config.toml", "");
  StoppingObserver never;
  Provenance before;
  before.seconds = 1000.0;
  before.started = "then";
  { const ProvenanceRecorder recorder(run, before, &never); }
  const auto after = ReadProvenance(run);
  EXPECT_GE(after->seconds, 1000.0);
  EXPECT_LT(after->seconds, 1060.0);
  EXPECT_EQ(after->started, "then");
  EXPECT_EQ(after->finished, "");
  before.finished = "long ago";
  { ProvenanceRecorder(run, before, &never).Finish(); }
  EXPECT_EQ(ReadProvenance(run)->finished, "");  // nothing was written
}

TEST(Provenance, OfADamagedFileIsRefusedByLineAndUnknownKeysAreLeftOut) {
  const TempFolder folder;
  const RunFolder run{folder.path()};
  folder.Write("provenance.toml", "[provenance]\nversion = \"9.1\"\nmood = \"good\"\n");
  EXPECT_EQ(ReadProvenance(run)->version, "9.1");
  folder.Write("provenance.toml", "[provenance]\nseconds = -1\n");
  try {
    ReadProvenance(run);
    FAIL() << "a negative time was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("provenance.toml:2"), std::string::npos);
  }
}

}  // namespace
}  // namespace antigrasp
