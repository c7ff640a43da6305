#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/error.h"
#include "antigrasp/quality/named_gripper.h"
#include "antigrasp/train/cem_run.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct TrainFlags {
  std::string config;
  std::string out;
  std::string resume;
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::optional<int> threads;
  std::string device;
  std::shared_ptr<std::string> gripper;
  std::string mode;
  std::string start;
  bool fine_tune = false;
  bool from_scratch = false;
  bool or_resume = false;
  bool overwrite = false;
};

// What a run that begins with these networks has for model.* if it does not say otherwise.
ModelOptions ModelOf(const std::string& networks) {
  const fs::path path = FindNetworks(networks);
  return NetworksFromToml(ReadCheckpoint(path).config, path.string()).model;
}

// --set takes every word up to the next option, so also a configuration that stands behind the
// settings: the word that is no KEY=VALUE.
void TakeConfigFromSettings(TrainFlags* flags) {
  const auto config =
      std::find_if(flags->overrides.begin(), flags->overrides.end(), [](const std::string& word) {
        const std::size_t equals = word.find('=');
        return equals == std::string::npos || word.find('/') < equals;
      });
  if (config == flags->overrides.end() || !flags->config.empty()) return;
  flags->config = *config;
  flags->overrides.erase(config);
}

RunConfig ReadConfig(const TrainFlags& flags) {
  RunConfig config;
  OptionTable table;
  Bind(&table, &config);
  if (!flags.start.empty()) config.model = ModelOf(flags.start);
  if (!flags.config.empty()) table.ApplyFile(flags.config);
  if (!flags.gripper->empty()) ApplyGripper(*flags.gripper, &config.metric);
  for (const std::string& text : flags.overrides) table.ApplyOverride(text);
  if (flags.seed) config.seed = *flags.seed;
  if (flags.threads) table.ApplyValue("run.threads", std::to_string(*flags.threads), "--threads");
  if (!flags.device.empty()) config.device = flags.device;
  if (!flags.mode.empty()) table.ApplyValue("cem.mode", flags.mode, "--mode");
  if (!flags.start.empty()) config.start = flags.start;
  if (flags.fine_tune) config.fine_tune = true;
  if (flags.from_scratch) {
    config.start.clear();
    config.fine_tune = false;
  }
  const std::string origin = flags.config.empty() ? "configuration" : flags.config;
  Validate(config, origin);
  RequireFittingGripper(config.metric, origin);
  WarnOfLengths(config.metric);
  return config;
}

RunResult Start(const TrainFlags& flags, RunObserver* console) {
  const RunConfig config = ReadConfig(flags);
  const RunFolder run{flags.out};
  if (flags.or_resume && !flags.overwrite && run.HoldsARun()) {
    if (ToToml(ConfigOfRun(run.root)) != ToToml(config)) {
      throw InputError("the run in " + flags.out + " was started with other settings",
                       run.Config().string(), "the same settings, --overwrite or another --out");
    }
    return ResumeRun(run.root, console);
  }
  if (flags.overwrite && run.HoldsARun()) {
    RequireInputs(config, run.root);  // what is refused costs no run
    run.Remove();
  }
  return StartRun(config, flags.out, console);
}

void Train(const TrainFlags& flags) {
  if (flags.resume.empty() == flags.out.empty()) {
    throw InputError("train needs a folder", "command line",
                     "--out RUN for a new run or --resume RUN to go on");
  }
  if (!flags.resume.empty() &&
      (!flags.config.empty() || !flags.overrides.empty() || !flags.gripper->empty())) {
    throw InputError("--resume with a configuration", "command line",
                     "--resume RUN alone: a run goes on with the settings it began with");
  }
  ConsoleObserver console;
  const std::string folder = flags.resume.empty() ? flags.out : flags.resume;
  try {
    const RunResult result =
        flags.resume.empty() ? Start(flags, &console) : ResumeRun(flags.resume, &console);
    std::printf("%s", StatisticsTable(result.stages, result.control).c_str());
    std::printf("run: %s\n", folder.c_str());
    const RunFolder run{folder};
    if (fs::exists(run.Stl())) {
      std::printf("least graspable objects, mm: %s\n", run.Stl().string().c_str());
    }
  } catch (const Interrupted&) {
    if (RunFolder{folder}.HoldsARun()) {
      spdlog::warn("stopped; go on with: antigrasp train --resume {}", folder);
    }
    throw;
  }
}

}  // namespace

void AddTrainCommand(CLI::App* app) {
  const auto flags = std::make_shared<TrainFlags>();
  CLI::App* command = app->add_subcommand(kTrain.name, kTrain.description);
  command->add_option("CONFIG", flags->config, "configuration (TOML); without one, defaults");
  command->add_option("--out", flags->out, "folder of the new run");
  command->add_option("--resume", flags->resume, "go on with the run in this folder");
  command->add_flag("--or-resume", flags->or_resume,
                    "if --out holds a run of the same settings, go on with it");
  command->add_flag("--overwrite", flags->overwrite, "delete a run that --out holds");
  command
      ->add_option("--set", flags->overrides,
                   "override settings: --set gan.batch=16 cem.episodes=2; may be repeated")
      ->type_name("KEY=VALUE");
  flags->gripper = AddGripperFlag(command, "Options");
  command->add_option("--seed", flags->seed, "same as --set run.seed=");
  command->add_option("--threads", flags->threads, "same as --set run.threads=");
  command->add_option("--device", flags->device, "same as --set run.device=");
  command->add_option("--mode", flags->mode,
                      "same as --set cem.mode=: " + Alternatives(ChoiceNames<EpisodeMode>()));
  CLI::Option* from = command->add_option(
      "--from", flags->start, "same as --set run.start=, and takes model.* from these networks");
  CLI::Option* fine_tune =
      command->add_flag("--fine-tune", flags->fine_tune,
                        "train the networks of --from on in episode 0: same as run.fine_tune=true");
  command->add_flag("--from-scratch", flags->from_scratch, "train episode 0: no run.start")
      ->excludes(from, fine_tune);
  command->callback([flags] {
    TakeConfigFromSettings(flags.get());
    Train(*flags);
  });
}

}  // namespace antigrasp
