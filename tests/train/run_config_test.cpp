#include "antigrasp/train/run_config.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

TEST(RunConfig, ReadsItsOwnDump) {
  RunConfig config;
  config.seed = 42;
  config.cem.keep = 7;
  config.prior.kind = "bottles";
  config.metric.friction = 1.0 / 3;
  config.metric.collision = Collision::kJaws;
  config.metric.gripper.finger_width = 0.015;
  const std::string toml = ToToml(config);
  EXPECT_EQ(ToToml(FromToml(toml, "x")), toml);
  EXPECT_NE(toml.find("[gripper]"), std::string::npos);
  EXPECT_EQ(FromToml(toml, "x").metric.gripper.finger_width, 0.015);
}

// Every key of run, prior and cem but the switches, each with a value of its own.
constexpr const char* kOwnValues = R"(
[run]
seed = 101
threads = 3
torch_threads = 4
device = "cuda:1"
stl_count = 5
stl_size_mm = 61.5
start = "networks"
[prior]
file = "set.h5"
kind = "prisms"
count = 17
seed = 102
[cem]
mode = "latent"
episodes = 6
prior_iterations = 7
iterations = 8
samples = 90
keep = 9
variant = "stratified"
cells = 11
neighbours = 7
spread = 92.5
step = 0.25
select = "random"
score = "judge:ours"
refine_steps = 16
refine_hausdorff = 1.5
refine_niches = 18
refine_admits = 87.5
part_step = 0.45
prior_fraction = 0.75
prior_scored = 13
compared = 14
checkpoint_every = 15
)";

TEST(RunConfig, BindsEveryKeyToItsOwnField) {
  const RunConfig config = FromToml(kOwnValues, "x");
  EXPECT_EQ(config.seed, 101U);
  EXPECT_EQ(config.threads, 3);
  EXPECT_EQ(config.torch_threads, 4);
  EXPECT_EQ(config.device, "cuda:1");
  EXPECT_EQ(config.stl_count, 5);
  EXPECT_EQ(config.stl_size_mm, 61.5);
  EXPECT_EQ(config.start, "networks");
  EXPECT_EQ(config.prior_file, "set.h5");
  EXPECT_EQ(config.prior.kind, "prisms");
  EXPECT_EQ(config.prior.count, 17);
  EXPECT_EQ(config.prior.seed, 102U);
  EXPECT_EQ(config.cem.mode, EpisodeMode::kLatent);
  EXPECT_EQ(config.cem.episodes, 6);
  EXPECT_EQ(config.cem.prior_iterations, 7);
  EXPECT_EQ(config.cem.iterations, 8);
  EXPECT_EQ(config.cem.samples, 90);
  EXPECT_EQ(config.cem.keep, 9);
  EXPECT_EQ(config.cem.variant, EliteRule::kStratified);
  EXPECT_EQ(config.cem.cells, 11);
  EXPECT_EQ(config.cem.neighbours, 7);
  EXPECT_EQ(config.cem.spread, 92.5);
  EXPECT_EQ(config.cem.step, 0.25);
  EXPECT_EQ(config.cem.select, EliteOrder::kRandom);
  EXPECT_EQ(config.cem.score, "judge:ours");
  EXPECT_EQ(config.cem.refine_steps, 16);
  EXPECT_EQ(config.cem.refine_hausdorff, 1.5);
  EXPECT_EQ(config.cem.refine_niches, 18);
  EXPECT_EQ(config.cem.refine_admits, 87.5);
  EXPECT_EQ(config.cem.part_step, 0.45);
  EXPECT_EQ(config.cem.prior_fraction, 0.75);
  EXPECT_EQ(config.cem.prior_scored, 13);
  EXPECT_EQ(config.cem.compared, 14);
  EXPECT_EQ(config.cem.checkpoint_every, 15);
  // No key was forgotten here: what is not a switch differs from its default.
  RunConfig read = config, defaults;
  OptionTable ours, theirs;
  Bind(&ours, &read);
  Bind(&theirs, &defaults);
  for (std::size_t i = 0; i < ours.options().size(); ++i) {
    const Option& option = ours.options()[i];
    const std::string section = option.key.substr(0, option.key.find('.'));
    const bool asked = section == "run" || section == "prior" || section == "cem";
    if (!asked || std::holds_alternative<bool*>(option.target)) continue;
    EXPECT_NE(ValueText(option), ValueText(theirs.options()[i])) << option.key;
  }
}

TEST(RunConfig, BindsEverySwitchToItsOwnField) {
  const std::vector<std::pair<std::string, bool (*)(const RunConfig&)>> switches = {
      {"run.fine_tune", [](const RunConfig& c) { return c.fine_tune; }},
      {"cem.restart", [](const RunConfig& c) { return c.cem.restart; }},
      {"cem.redistance", [](const RunConfig& c) { return c.cem.redistance; }},
      {"cem.check_self_intersection",
       [](const RunConfig& c) { return c.cem.check_self_intersection; }},
      {"cem.control", [](const RunConfig& c) { return c.cem.control; }}};
  const RunConfig defaults;
  for (const auto& [key, of] : switches) {
    const RunConfig turned = FromToml(key + (of(defaults) ? " = false" : " = true"), "x");
    for (const auto& [other, value] : switches) {
      EXPECT_EQ(value(turned) != value(defaults), other == key) << key << " and " << other;
    }
  }
}

TEST(RunConfig, RefinesElitesOnlyWhereTheyAreLearntFrom) {
  RunConfig config = FromToml("cem.refine_steps = 5", "x");
  EXPECT_NO_THROW(Validate(config, "x"));
  config.cem.mode = EpisodeMode::kLatent;
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.cem.part_step = 0.3;  // of parts that a grid does not have
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.model.kind = ModelKind::kSolids;
  EXPECT_NO_THROW(Validate(config, "x"));
  config.cem.refine_admits = 90.0;  // by niches that there are not
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.cem.refine_niches = 40;
  EXPECT_NO_THROW(Validate(config, "x"));
  config.cem.refine_steps = 0;
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.cem.refine_steps = 5;
  config.cem.refine_niches = 0;
  config.cem.refine_admits = 100.0;
  config.cem.mode = EpisodeMode::kGan;
  EXPECT_THROW(Validate(config, "x"), InputError);
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

TEST(RunConfig, RefusesAResolutionThatLayersCannotHalve) {
  RunConfig config;
  for (const int resolution : {16, 32, 64, 128}) {
    config.model.resolution = resolution;
    EXPECT_NO_THROW(Validate(config, "x")) << resolution;
  }
  config.model.resolution = 48;
  EXPECT_THROW(Validate(config, "x"), InputError);
  EXPECT_THROW(NetworksFromToml("[model]\nresolution = 48\n", "x"), InputError);
}

TEST(RunConfig, RefusesMirrorsAndUpsideDownForTurnedSolids) {
  RunConfig config;
  config.model.kind = ModelKind::kSolids;
  config.model.form = PartForm::kTurned;
  config.gan.symmetries = Symmetries::kAroundZ;
  EXPECT_NO_THROW(Validate(config, "x"));
  config.gan.symmetries = Symmetries::kAroundZAndUp;
  EXPECT_THROW(Validate(config, "x"), InputError);
  config.model.form = PartForm::kBoxes;
  EXPECT_NO_THROW(Validate(config, "x"));
  config.model.form = PartForm::kTurned;
  config.gan.symmetries = Symmetries::kNone;
  config.gan.augment = Augmentation::kFlips;
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
