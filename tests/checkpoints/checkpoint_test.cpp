#include "antigrasp/checkpoints/checkpoint.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <torch/serialize/archive.h>
#include <torch/types.h>

#include <csignal>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

Checkpoint Sample() {
  Checkpoint checkpoint;
  checkpoint.config = "[run]\nseed = 5\n";
  checkpoint.statistics = "stage\n-1\n";
  checkpoint.shapes = torch::arange(64, torch::kFloat).reshape({2, 1, 4, 2, 4}).to(torch::kHalf);
  checkpoint.losses = torch::rand({3, 3}, torch::kDouble);
  checkpoint.networks = {{"last/weight", torch::ones({2, 3})},
                         {"bias", torch::arange(4, torch::kLong)}};
  checkpoint.finished = true;
  return checkpoint;
}

std::string MessageOf(const std::filesystem::path& path) {
  try {
    ReadCheckpoint(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Checkpoint, ReadsBackWhatWasWritten) {
  const TempFolder folder;
  const Checkpoint written = Sample();
  WriteCheckpoint(folder / "a.pt", written);
  const Checkpoint read = ReadCheckpoint(folder / "a.pt");
  EXPECT_EQ(read.config, written.config);
  EXPECT_EQ(read.statistics, written.statistics);
  EXPECT_EQ(read.finished, written.finished);
  EXPECT_TRUE(torch::equal(read.shapes, written.shapes));
  EXPECT_EQ(read.shapes.scalar_type(), torch::kHalf);
  EXPECT_TRUE(torch::equal(read.losses, written.losses));
  ASSERT_EQ(read.networks.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {  // in the order in which they were written
    EXPECT_EQ(read.networks[i].first, written.networks[i].first);
    EXPECT_TRUE(torch::equal(read.networks[i].second, written.networks[i].second));
  }
}

TEST(Checkpoint, OneThatWasReadIsWrittenWithTheSameBytes) {
  const TempFolder folder;
  Checkpoint checkpoint = Sample();
  const torch::Tensor large = torch::arange(12, torch::kFloat).reshape({3, 4});
  checkpoint.networks.emplace_back("turned", large.t());
  WriteCheckpoint(folder / "a.pt", checkpoint);
  WriteCheckpoint(folder / "b.pt", ReadCheckpoint(folder / "a.pt"));
  EXPECT_EQ(ReadFile(folder / "a.pt"), ReadFile(folder / "b.pt"));
}

TEST(Checkpoint, EntriesOfTheArchiveHaveTheirDocumentedNames) {
  const TempFolder folder;
  Checkpoint checkpoint = Sample();
  for (const bool finished : {true, false}) {
    checkpoint.finished = finished;
    WriteCheckpoint(folder / "a.pt", checkpoint);
    EXPECT_EQ(ReadCheckpoint(folder / "a.pt").finished, finished);
    torch::serialize::InputArchive archive, networks;
    archive.load_from((folder / "a.pt").string());
    const auto value = [&](const char* name) {
      c10::IValue entry;
      archive.read(name, entry);
      return entry;
    };
    EXPECT_EQ(value("format").toStringRef(), "antigrasp.checkpoint");
    EXPECT_EQ(value("version").toInt(), 1);
    EXPECT_EQ(value("config").toStringRef(), "[run]\nseed = 5\n");
    EXPECT_EQ(value("statistics").toStringRef(), "stage\n-1\n");
    EXPECT_EQ(value("finished").toBool(), finished);
    EXPECT_TRUE(torch::equal(value("shapes").toTensor(), checkpoint.shapes));
    EXPECT_TRUE(torch::equal(value("losses").toTensor(), checkpoint.losses));
    ASSERT_TRUE(archive.try_read("networks", networks));
    torch::Tensor weight;
    networks.read("last/weight", weight, true);
    EXPECT_TRUE(torch::equal(weight, torch::ones({2, 3})));
  }
}

TEST(Checkpoint, RefusesAnotherFormatOfTheSameVersion) {
  const TempFolder folder;
  torch::serialize::OutputArchive other;
  other.write("format", c10::IValue(std::string("antigrasp.other")));
  other.write("version", c10::IValue(std::int64_t{1}));
  other.save_to((folder / "other.pt").string());
  EXPECT_NE(MessageOf(folder / "other.pt").find("another kind of archive"), std::string::npos);
  EXPECT_FALSE(IsCheckpoint(folder / "other.pt"));
  WriteCheckpoint(folder / "a.pt", Sample());
  EXPECT_TRUE(IsCheckpoint(folder / "a.pt"));
}

TEST(Checkpoint, EqualStatesGiveEqualBytesUnderAnyName) {
  const TempFolder folder;
  const Checkpoint checkpoint = Sample();
  WriteCheckpoint(folder / "a.pt", checkpoint);
  WriteCheckpoint(folder / "another.pt", checkpoint);
  EXPECT_EQ(ReadFile(folder / "a.pt"), ReadFile(folder / "another.pt"));
}

TEST(Checkpoint, NamesWhatIsWrongWithAFile) {
  const TempFolder folder;
  EXPECT_NE(MessageOf(folder / "missing.pt").find("no such file"), std::string::npos);
  EXPECT_NE(MessageOf(folder.path()).find("is a folder"), std::string::npos);
  WriteFileAtomic(folder / "text.pt", "this is no archive");
  EXPECT_NE(MessageOf(folder / "text.pt").find("not a checkpoint"), std::string::npos);
  EXPECT_FALSE(IsCheckpoint(folder / "text.pt"));
}

TEST(Checkpoint, RefusesEveryTruncation) {
  const TempFolder folder;
  WriteCheckpoint(folder / "a.pt", Sample());
  const std::string bytes = ReadFile(folder / "a.pt");
  for (std::size_t length = 0; length < bytes.size(); length += bytes.size() / 50 + 1) {
    WriteFileAtomic(folder / "cut.pt", bytes.substr(0, length));
    EXPECT_NE(MessageOf(folder / "cut.pt").find("expected an antigrasp checkpoint of version 1"),
              std::string::npos)
        << length;
  }
}

TEST(Checkpoint, RefusesAForeignArchiveAndAnotherVersion) {
  const TempFolder folder;
  torch::serialize::OutputArchive foreign;
  foreign.write("weight", torch::ones({1}));
  foreign.save_to((folder / "foreign.pt").string());
  EXPECT_NE(MessageOf(folder / "foreign.pt").find("no entry 'format'"), std::string::npos);

  for (const std::int64_t version : {0, 2, 99}) {  // older ones as newer ones
    torch::serialize::OutputArchive other;
    other.write("format", c10::IValue(std::string("antigrasp.checkpoint")));
    other.write("version", c10::IValue(version));
    other.save_to((folder / "other.pt").string());
    EXPECT_NE(MessageOf(folder / "other.pt").find("checkpoint version " + std::to_string(version)),
              std::string::npos);
  }
}

TEST(Checkpoint, AFullDiskKeepsTheLastGoodOne) {
  const TempFolder folder;
  WriteCheckpoint(folder / "a.pt", Sample());
  const std::string before = ReadFile(folder / "a.pt");
  Checkpoint large = Sample();
  large.shapes = torch::zeros({4, 1, 32, 32, 32}, torch::kHalf);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  rlimit tight = limit;
  tight.rlim_cur = 10000;
  setrlimit(RLIMIT_FSIZE, &tight);
  EXPECT_THROW(WriteCheckpoint(folder / "a.pt", large), RuntimeFailure);
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_EQ(ReadFile(folder / "a.pt"), before);
}

}  // namespace
}  // namespace antigrasp
