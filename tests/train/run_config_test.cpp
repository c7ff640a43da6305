#include "antigrasp/train/run_config.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

TEST(RunConfig, ReadsItsOwnDump) {
  RunConfig config;
  config.seed = 42;
  config.cem.keep = 7;
  config.prior.kind = "bottles";
  config.metric.friction = 1.0 / 3;
  config.metric.collision = "jaws";
  config.metric.gripper.finger_width = 0.015;
  const std::string toml = ToToml(config);
  EXPECT_EQ(ToToml(FromToml(toml, "x")), toml);
  EXPECT_NE(toml.find("[gripper]"), std::string::npos);
  EXPECT_EQ(FromToml(toml, "x").metric.gripper.finger_width, 0.015);
}

TEST(RunConfig, ForSamplingKeysOfAnotherVersionAreLeftOutButNotThoseOfTheNetworks) {
  const std::string old = "[metric]\nbootstrap = 1000\n[model]\nwidth = 5\n";
  EXPECT_EQ(NetworksFromToml(old, "x").model.width, 5);
  EXPECT_THROW(FromToml(old, "x"), InputError);
  EXPECT_EQ(NetworksFromToml("[model]\ncomponents = 8\nwidth = 5\n", "x").model.width, 5)
      << "a key that is retired";
  EXPECT_THROW(NetworksFromToml("[model]\nattention = true\n", "x"), InputError);
  EXPECT_THROW(NetworksFromToml("[model]\nwidth = 0\n", "x"), InputError);
}

TEST(RunConfig, HoldsThePapersNumbersByDefault) {
  const RunConfig config;
  EXPECT_EQ(config.cem.samples, 2500);
  EXPECT_EQ(config.cem.keep, 500);
  EXPECT_EQ(config.cem.iterations, 16000);
  EXPECT_EQ(config.model.latent, 200);
  EXPECT_EQ(config.metric.percentile, 75.0);
  EXPECT_EQ(config.metric.friction, 0.5);
}

TEST(RunConfig, TheShippedFilesAreValid) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ANTIGRASP_CONFIGS)) {
    RunConfig config;
    OptionTable table;
    Bind(&table, &config);
    const std::string path = entry.path().string();
    EXPECT_NO_THROW(table.ApplyFile(path)) << path;
    EXPECT_NO_THROW(Validate(config, path)) << path;
    ++files;
  }
  EXPECT_GE(files, 6);
}

TEST(RunConfig, RefusesToTrainOnNetworksThatAreNotGiven) {
  RunConfig config;
  config.fine_tune = true;
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.start = "bottles-prior";
  EXPECT_NO_THROW(Validate(config, "x"));
}

TEST(RunConfig, RefusesToKeepMoreThanItSamples) {
  RunConfig config;
  config.cem.samples = 10;
  config.cem.keep = 11;
  EXPECT_THROW(Validate(config, "x"), InputError);
}

TEST(RunConfig, RefusesABatchThatIsNoWholeNumberOfPacks) {
  RunConfig config;
  config.model.pack = 3;
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.gan.batch = 33;
  EXPECT_NO_THROW(Validate(config, "x"));
}

}  // namespace
}  // namespace antigrasp
