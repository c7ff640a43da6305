#include "antigrasp/core/launch.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

std::optional<Launch> From(const std::map<std::string, std::string>& environment) {
  return LaunchOfEnvironment([&](const char* name) -> const char* {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

std::string Refusal(const std::map<std::string, std::string>& environment) {
  try {
    From(environment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Launch, WithoutALauncherAProcessIsAlone) {
  EXPECT_FALSE(From({}).has_value());
  EXPECT_FALSE(From({{"MASTER_ADDR", "a"}, {"RANK", "0"}}).has_value());  // no WORLD_SIZE
}

TEST(Launch, OfTorchrunIsInItsFiveVariables) {
  const auto launch = From({{"RANK", "5"},
                            {"WORLD_SIZE", "8"},
                            {"LOCAL_WORLD_SIZE", "4"},
                            {"MASTER_ADDR", "node07"},
                            {"MASTER_PORT", "1234"}});
  ASSERT_TRUE(launch.has_value());
  EXPECT_EQ(launch->rank, 5);
  EXPECT_EQ(launch->size, 8);
  EXPECT_EQ(launch->local, 4);
  EXPECT_EQ(launch->host, "node07");
  EXPECT_EQ(launch->port, 1234);
  EXPECT_FALSE(launch->leads());
  EXPECT_FALSE(launch->store_is_there);
}

TEST(Launch, WhereTorchrunListensItselfEveryRestartHasItsPrefix) {
  const auto launch = From({{"RANK", "0"},
                            {"WORLD_SIZE", "2"},
                            {"MASTER_ADDR", "a"},
                            {"MASTER_PORT", "1"},
                            {"TORCHELASTIC_USE_AGENT_STORE", "True"},
                            {"TORCHELASTIC_RESTART_COUNT", "3"}});
  ASSERT_TRUE(launch.has_value());
  EXPECT_TRUE(launch->leads());
  EXPECT_TRUE(launch->store_is_there);
  EXPECT_EQ(launch->prefix, "/worker/attempt_3");
}

TEST(Launch, OfSlurmListensOnTheFirstHostAtAPortOfTheJob) {
  const auto launch = From({{"SLURM_PROCID", "2"},
                            {"SLURM_NTASKS", "3"},
                            {"SLURM_STEP_ID", "0"},
                            {"SLURM_NTASKS_PER_NODE", "1"},
                            {"SLURM_JOB_NODELIST", "gpu[03-05,9]"},
                            {"SLURM_JOB_ID", "1025"}});
  ASSERT_TRUE(launch.has_value());
  EXPECT_EQ(launch->rank, 2);
  EXPECT_EQ(launch->host, "gpu03");
  EXPECT_EQ(launch->port, 29400 + 1);
  // An allocation without srun has no step: one process in it is alone.
  EXPECT_FALSE(From({{"SLURM_PROCID", "0"}, {"SLURM_NTASKS", "3"}}).has_value());
}

TEST(Launch, OfMpirunOnOneMachineNeedsAPortAlone) {
  std::map<std::string, std::string> of = {{"OMPI_COMM_WORLD_RANK", "1"},
                                           {"OMPI_COMM_WORLD_SIZE", "2"},
                                           {"OMPI_COMM_WORLD_LOCAL_SIZE", "2"},
                                           {"MASTER_PORT", "77"}};
  ASSERT_TRUE(From(of).has_value());
  EXPECT_EQ(From(of)->host, "127.0.0.1");
  of["OMPI_COMM_WORLD_LOCAL_SIZE"] = "1";  // two machines
  EXPECT_EQ(Refusal(of),
            "MASTER_ADDR is not set (environment): expected the address and a free port of the "
            "machine of rank 0");
}

TEST(Launch, NumbersOutOfRangeAreNamed) {
  EXPECT_EQ(Refusal({{"RANK", "2"}, {"WORLD_SIZE", "2"}}),
            "RANK = \"2\" (environment): expected a number from 0 to 1");
  EXPECT_EQ(Refusal({{"RANK", "0x"}, {"WORLD_SIZE", "2"}}),
            "RANK = \"0x\" (environment): expected a number from 0 to 1");
  EXPECT_EQ(
      Refusal({{"RANK", "0"}, {"WORLD_SIZE", "2"}, {"MASTER_ADDR", "a"}, {"MASTER_PORT", "65536"}}),
      "MASTER_PORT = \"65536\" (environment): expected a number from 0 to 65535");
}

TEST(Launch, SaysHowLongARankMayBeSilent) {
  std::map<std::string, std::string> of = {
      {"RANK", "0"}, {"WORLD_SIZE", "2"}, {"MASTER_ADDR", "a"}, {"MASTER_PORT", "1"}};
  EXPECT_EQ(From(of)->lost_after, 30.0);
  EXPECT_EQ(From(of)->FirstWait(), 45.0);  // within the 60 s in which a job ends
  of["ANTIGRASP_LOST_AFTER"] = "300";
  EXPECT_EQ(From(of)->lost_after, 300.0);
  EXPECT_EQ(From(of)->FirstWait(), 450.0);
  of["ANTIGRASP_LOST_AFTER"] = "0";
  EXPECT_EQ(Refusal(of),
            "ANTIGRASP_LOST_AFTER = \"0\" (environment): expected a number from 1 to 86400");
}

TEST(Launch, TheFirstHostOfASlurmList) {
  EXPECT_EQ(FirstHost("node1"), "node1");
  EXPECT_EQ(FirstHost("node1,node2"), "node1");
  EXPECT_EQ(FirstHost("rack2-[007,9]"), "rack2-007");
  EXPECT_EQ(FirstHost("a,b[1-2]"), "a");
}

}  // namespace
}  // namespace antigrasp
