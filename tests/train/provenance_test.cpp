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
  StoppingObserver stopping(24 + 17);  // in training
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
  StoppingObserver stopping(24 + 17), never;
  EXPECT_THROW(StartRun(Short(), run.root, &stopping), Interrupted);
  fs::remove(run.Provenance());
  ResumeRun(run.root, &never);
  EXPECT_FALSE(ReadProvenance(run));
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
