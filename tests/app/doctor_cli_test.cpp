#include <gtest/gtest.h>

#include <filesystem>

#include "tests/app/run_binary.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::Outcome;
using cli::Shell;
using shapes::TempFolder;

TEST(DoctorCli, TellsOfMeshesAndNetworksAndThatAllBytesAreTheExpectedOnes) {
  const Outcome outcome = Antigrasp("doctor");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  for (const char* part :
       {"\nself-test         made, remeshed, scored, perturbed", "\nnetworks          LibTorch ",
        "\ndevices           cpu", "\nnetworks found    bottles-adversarial, bottles-prior",
        "\nself-test         updated, sampled: the expected bytes\n"}) {
    EXPECT_NE(outcome.text.find(part), std::string::npos) << part << outcome.text;
  }
}

TEST(DoctorCli, SaysWhichFolderTheNetworksAreInAndThatOneAskedForIsNone) {
  const Outcome outcome = Shell("ANTIGRASP_PRETRAINED=/nonsense " ANTIGRASP_BINARY " doctor");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("checkpoints/pretrained)\n"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("not in ANTIGRASP_PRETRAINED, which is no folder: /nonsense\n"),
            std::string::npos)
      << outcome.text;
}

TEST(DoctorCli, AReportThatCannotBeWrittenIsNoSuccess) {
  for (const char* call : {" doctor >/dev/full", " --version >/dev/full", " doctor >&-"}) {
    const Outcome outcome = Shell("(" + std::string(ANTIGRASP_BINARY) + call + ")");
    EXPECT_EQ(outcome.code, 1) << call << outcome.text;
    EXPECT_NE(outcome.text.find("cannot write to standard output"), std::string::npos) << call;
  }
}

// `antigrasp` beside another antigrasp-networks: what a broken installation looks like.
Outcome DoctorBeside(const std::string& networks) {
  const TempFolder folder;
  fs::copy_file(ANTIGRASP_BINARY, folder / "antigrasp");
  if (!networks.empty()) {
    fs::permissions(folder.Write("antigrasp-networks", networks), fs::perms::owner_all);
  }
  return Shell((folder / "antigrasp").string() + " doctor");
}

TEST(DoctorCli, ABrokenHalfIsToldInALineBehindTheOther) {
  for (const auto& [networks, line] :
       {std::pair<std::string, std::string>{"",
                                            "antigrasp-networks failed: cannot be started (No "
                                            "such file or directory)"},
        {"#!/bin/sh\nkill -ILL $$\n",
         "antigrasp-networks failed: signal 4 (Illegal "
         "instruction)"},
        {"#!/bin/sh\n[ $1 = doctor ] && exit 3\n",
         "the self-test gave other bytes than expected (above)"}}) {
    const Outcome outcome = DoctorBeside(networks);
    EXPECT_EQ(outcome.code, 1) << outcome.text;
    EXPECT_NE(outcome.text.find("\nself-test "), std::string::npos) << outcome.text;
    EXPECT_TRUE(outcome.text.ends_with("antigrasp: " + line + "\n")) << outcome.text;
  }
}

}  // namespace
}  // namespace antigrasp
