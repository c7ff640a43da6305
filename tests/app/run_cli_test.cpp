// The commands train, sample and generator, and what they need of each other.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/shape_set.h"
#include "tests/app/run_binary.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using cli::Shell;
using shapes::TempFolder;

// A run of a few seconds, of everything but the networks' size.
const std::string kSettings = R"(
[run]
torch_threads = 1
stl_count = 2
[prior]
count = 8
[gan]
batch = 4
learning_rate_g = 4e-3
learning_rate_d = 4e-3
[cem]
episodes = 2
prior_iterations = 20
iterations = 4
samples = 8
keep = 3
control = true
prior_scored = 4
compared = 8
checkpoint_every = 4
[metric]
num_grasps = 10
num_draws = 4
max_attempts = 200
)";

void ExpectNear(const ShapeSet& a, const ShapeSet& b, double tolerance) {
  for (std::size_t i = 0; i < a.grids[4].values.size(); ++i) {
    ASSERT_NEAR(a.grids[4].values[i], b.grids[4].values[i], tolerance) << i;
  }
}

ShapeSet Sampled(const std::string& networks, int count, int seed, const fs::path& out) {
  const Outcome outcome = Antigrasp("sample " + networks + " --count " + std::to_string(count) +
                                    " --seed " + std::to_string(seed) + " --out " + out.string());
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  return ReadShapeSet(out);
}

// Stops a run by SIGINT, then by SIGKILL, then lets it end.
void RunInParts(const std::string& start, const fs::path& run) {
  const std::string binary = ANTIGRASP_BINARY;
  for (const char* seconds : {"0.8", "1.6", "3", "6", "12", "24"}) {  // until it is a run
    if (fs::exists(run / "config.toml")) break;
    Shell(std::string("timeout -s INT ") + seconds + " " + binary + start);
  }
  ASSERT_TRUE(fs::exists(run / "config.toml"));
  Shell("timeout -s KILL 1 " + binary + " train --resume " + run.string());
  ASSERT_EQ(Antigrasp("train --resume " + run.string()).code, 0);
}

void ExpectSamplesOfTheLastEpisode(const TempFolder& folder, const ShapeSet& five) {
  const std::string dir = folder.path().string() + "/";
  EXPECT_EQ(five.kind, "samples");
  EXPECT_EQ(five.seed, 7U);
  EXPECT_EQ(five.names[4], "sample-000004");
  EXPECT_TRUE(five.provenance.ends_with("checkpoint.pt, episode 2, update 4")) << five.provenance;
  const ShapeSet nine = Sampled(dir + "whole", 9, 7, folder / "9.h5");
  EXPECT_EQ(five.grids[4].values, nine.grids[4].values);
  EXPECT_NE(five.grids[4].values, five.grids[3].values);
  EXPECT_NE(five.grids[4].values, Sampled(dir + "whole", 5, 8, folder / "8.h5").grids[4].values);
}

// The networks alone, float16: sampled alike but for rounding, and good to begin with.
void ExpectNetworksAlone(const TempFolder& folder, const ShapeSet& exact) {
  const std::string dir = folder.path().string() + "/", lean = "train " + dir + "lean.toml ";
  const Outcome written = Antigrasp("generator " + dir + "whole --out " + dir + "small.pt");
  ASSERT_EQ(written.code, 0) << written.text;
  EXPECT_NE(written.text.find("small.pt: networks of episode 2, "), std::string::npos);
  EXPECT_LT(fs::file_size(folder / "small.pt"), fs::file_size(folder / "whole/checkpoint.pt") / 4);
  ExpectNear(exact, Sampled(dir + "small.pt", 5, 7, folder / "s.h5"), 5e-3);
  // The same without batch normalisation, and good to train on.
  ASSERT_EQ(
      Antigrasp("generator " + dir + "whole --fold-batch-norm --out " + dir + "folded.pt").code, 0);
  ExpectNear(exact, Sampled(dir + "folded.pt", 5, 7, folder / "f.h5"), 1e-2);
  const Outcome on = Antigrasp(lean + "--from " + dir + "folded.pt --fine-tune --threads 2 " +
                               "--set cem.episodes=0 --set cem.control=false --out " + dir + "on");
  EXPECT_EQ(on.code, 0) << on.text;
  ExpectRefused("generator " + dir + "folded.pt --fold-batch-norm --out " + dir + "x.pt",
                "batch_norm = false");
  EXPECT_FALSE(fs::exists(folder / "x.pt"));
}

// A flag wins over --set, --set over the file, and what the file leaves open comes from --from.
void ExpectSettingsByRank(const TempFolder& folder) {
  const std::string dir = folder.path().string() + "/";
  const Outcome latent =
      Antigrasp("train --set run.seed=3 cem.mode=gan " + dir + "lean.toml --from " + dir +
                "small.pt --mode latent --seed 9 --threads 2 --set cem.control=false " +
                "cem.episodes=1 --set gan.batch=6 --out " + dir + "latent");
  EXPECT_EQ(latent.code, 0) << latent.text;
  const std::string config = ReadFile(folder / "latent/config.toml");
  for (const std::string& line :
       {std::string("\nmode = 'latent' "), std::string("[run]\nseed = 9 "),
        std::string("\nthreads = 2 "), std::string("\ntorch_threads = 1 "),
        "\nstart = '" + dir + "small.pt' ", std::string("\nfine_tune = false "),
        std::string("\nbatch = 6 "), std::string("\nwidth = 4 "), std::string("\nlatent = 8 "),
        std::string("\nepisodes = 1 ")}) {
    EXPECT_NE(config.find(line), std::string::npos) << line << "\n" << config;
  }
  const std::string on = ReadFile(folder / "on/config.toml");
  EXPECT_NE(on.find("\nfine_tune = true "), std::string::npos) << on;
  EXPECT_NE(on.find("\nbatch_norm = false "), std::string::npos) << on;
}

// The whole way from a prior set to a printable file, at twice the paper's resolution.
TEST(RunCli, AFinerGridGoesThroughEveryCommand) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  folder.Write("fine.toml", kSettings + "[model]\nresolution = 64\nwidth = 2\nlatent = 4\n");
  const Outcome run = Antigrasp(
      "train " + dir + "fine.toml --threads 2 --set prior.count=4 --set cem.prior_iterations=12 " +
      "--set gan.learning_rate_g=2e-3 --set gan.learning_rate_d=2e-3 " +
      "--set cem.iterations=2 --set cem.episodes=1 --set cem.samples=4 --set cem.keep=1 " +
      "--set cem.control=false --set cem.compared=4 --set run.stl_count=1 --out " + dir + "run");
  ASSERT_EQ(run.code, 0) << run.text;
  const ShapeSet samples = Sampled(dir + "run", 4, 7, folder / "s.h5");
  ASSERT_EQ(samples.grids.size(), 4u);
  EXPECT_EQ(samples.grids[3].n, 64);
  EXPECT_EQ(samples.grids[3].spacing, 1.0 / 64.0);
  for (const std::string& command :
       {"remesh " + dir + "s.h5 --out " + dir + "meshes", "info " + dir + "s.h5",
        "evaluate " + dir + "s.h5 --num-grasps 10 --num-draws 4 --out " + dir + "s.csv",
        "export " + dir + "s.h5 --out " + dir + "prints",
        "dataset make prisms --count 2 --resolution 64 --out " + dir + "p.h5"}) {
    const Outcome outcome = Antigrasp(command);
    EXPECT_EQ(outcome.code, 0) << command << "\n" << outcome.text;
  }
  EXPECT_NE(ReadFile(folder / "s.csv").find("\nsample-000003,"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "prints/print.csv"));
  EXPECT_EQ(ReadShapeSet(folder / "p.h5").grids[1].n, 64);
  ExpectRefused("train " + dir + "fine.toml --set model.resolution=48 --out " + dir + "x",
                "model.resolution = 48");
  EXPECT_FALSE(fs::exists(folder / "x"));
}

// Over ten seconds: a third of it is LibTorch, loaded by some twenty-five processes, and the runs
// are of the size below which the generator makes no solids.
TEST(RunCli, ASecondProcessIsRefusedInALineAndAKilledOneBlocksNobody) {
  const TempFolder folder;
  const std::string run = (folder / "run").string();
  folder.Write("run.toml", kSettings);
  // Killed when the other has had its answer: `$!` is the process that trains.
  const Outcome outcome =
      Shell(std::string(ANTIGRASP_BINARY) + " train " + (folder / "run.toml").string() +
            " --set cem.prior_iterations=100000 --out " + run + " >/dev/null 2>&1 & first=$!; " +
            "for i in $(seq 600); do [ -e " + run + "/checkpoint.pt ] && break; sleep 0.1; done; " +
            ANTIGRASP_BINARY + " train --resume " + run +
            " 2>&1; echo code $? of $first; kill -KILL $first");
  const std::string pid = outcome.text.substr(outcome.text.rfind(' ') + 1);
  EXPECT_TRUE(
      outcome.text.starts_with("antigrasp: process " + pid.substr(0, pid.size() - 1) + " on "))
      << outcome.text;
  EXPECT_NE(outcome.text.find(" trains this run (" + run + "): expected one process at a time"),
            std::string::npos)
      << outcome.text;
  EXPECT_NE(outcome.text.find("\ncode 2 of "), std::string::npos) << outcome.text;
  EXPECT_TRUE(fs::exists(folder / "run/.lock"));
  folder.Write("run/.checkpoint.pt.antigrasp.tmp", "half");
  const Outcome resumed = Shell(std::string(ANTIGRASP_BINARY) + " train --resume " + run +
                                " 2>&1 & resumed=$!; for i in $(seq 600); do [ -e " + run +
                                "/.checkpoint.pt.antigrasp.tmp ] || break; sleep 0.1; done; sleep "
                                "0.2; kill -TERM $resumed; wait $resumed");
  EXPECT_NE(resumed.text.find("removed 1 unfinished files"), std::string::npos) << resumed.text;
  EXPECT_FALSE(fs::exists(folder / "run/.checkpoint.pt.antigrasp.tmp"));
  EXPECT_FALSE(fs::exists(folder / "run/.lock"));
}

TEST(RunCli, ARunCanBeKilledResumedSampledAndExported) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  folder.Write("lean.toml", kSettings);
  folder.Write("tiny.toml", kSettings + "[model]\nwidth = 4\nlatent = 8\n");
  const std::string start = " train " + dir + "tiny.toml --threads 2 --out " + dir;
  ASSERT_EQ(Antigrasp(start + "whole").code, 0);
  RunInParts(start + "parts", folder / "parts");
  for (const char* name : {"checkpoint.pt", "episode_0/scores.csv", "episode_2/scores.csv",
                           "episode_2/elites.h5", "control/checkpoint.pt"}) {
    EXPECT_TRUE(ReadFile(folder / "whole" / name) == ReadFile(folder / "parts" / name)) << name;
  }
  ExpectRefused(start + "whole", "a run is already there");
  // What is refused costs no run, nor the networks that are read.
  const std::string run = dir + "whole", kept = ReadFile(folder / "whole/checkpoint.pt");
  ExpectRefused(start + "whole --overwrite --set prior.file=" + dir + "none.h5", "none.h5");
  ExpectRefused(start + "whole --overwrite --set prior.file=" + run + "/prior.h5",
                "lies in the run that is to be overwritten");
  for (const char* command : {"sample ", "generator "}) {
    ExpectRefused(command + run + " --out " + run + "/checkpoint.pt",
                  "would be written over a file that is read");
  }
  EXPECT_TRUE(ReadFile(folder / "whole/checkpoint.pt") == kept);
  EXPECT_EQ(Antigrasp(start + "parts --or-resume --overwrite --set cem.episodes=0 " +
                      "--set cem.control=false")
                .code,
            0);
  EXPECT_FALSE(fs::exists(folder / "parts/episode_1"));
  const Outcome again = Antigrasp(start + "whole --or-resume");
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.text.find("control 2"), std::string::npos) << again.text;
  ExpectRefused(start + "whole --or-resume --seed 2", "other settings");
  const ShapeSet five = Sampled(dir + "whole", 5, 7, folder / "5.h5");
  ExpectSamplesOfTheLastEpisode(folder, five);
  ExpectNetworksAlone(folder, five);
  ExpectSettingsByRank(folder);
  ExpectRefused("sample nobody-made-this --out " + dir + "x.h5", "no such networks");
  for (const char* file : {"whole", "5.h5", "whole/episode_1/checkpoint.pt", "small.pt"}) {
    const Outcome info = Antigrasp("info " + dir + file);
    EXPECT_EQ(info.code, 0) << info.text;
    EXPECT_NE(info.text.find("antigrasp"), std::string::npos) << info.text;
  }
  // Of the whole run and its control, as train printed it.
  EXPECT_NE(again.text.find(Antigrasp("info " + dir + "whole")
                                .text.substr(std::string(dir + "whole: antigrasp run\n").size())),
            std::string::npos);
}

// What a run leaves but what holds the time of day.
std::map<std::string, std::string> Results(const fs::path& run) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(run)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file() || name == "provenance.toml") continue;
    if (entry.path().parent_path().filename() == "tensorboard") continue;
    files[fs::relative(entry.path(), run).string()] = ReadFile(entry.path());
  }
  return files;
}

TEST(RunCli, AControlBesideItsRunHasTheBytesOfOneAfterIt) {
  const TempFolder folder;
  folder.Write("run.toml", kSettings + "[model]\nwidth = 4\nlatent = 8\n");
  const std::string start = "train " + folder.path().string() + "/run.toml --threads 2 --out ";
  const Outcome beside = Antigrasp(start + (folder / "beside").string());
  const Outcome after = Antigrasp(start + (folder / "after").string() + " --control-after");
  ASSERT_EQ(beside.code, 0) << beside.text;
  ASSERT_EQ(after.code, 0) << after.text;
  EXPECT_NE(beside.text.find("in a process beside this one"), std::string::npos) << beside.text;
  EXPECT_EQ(after.text.find("in a process beside this one"), std::string::npos) << after.text;
  // The other process did all of it: nothing was left to go on with.
  EXPECT_EQ(beside.text.find("resuming"), std::string::npos) << beside.text;
  EXPECT_EQ(beside.text.find("ended early"), std::string::npos) << beside.text;
  EXPECT_NE(after.text.find("resuming"), std::string::npos) << after.text;
  const auto expected = Results(folder / "after");
  EXPECT_TRUE(expected.contains("control/episode_2/elites.h5"));
  EXPECT_TRUE(expected.contains("control/checkpoint.pt"));
  EXPECT_TRUE(expected == Results(folder / "beside"));
}

}  // namespace
}  // namespace antigrasp
