#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/core/error.h"
#include "antigrasp/judge/make_judge.h"
#include "antigrasp/perturb/hold_descent.h"
#include "antigrasp/ranks/follow.h"
#include "antigrasp/train/run_request.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct TrainFlags {
  RunRequest run;
  std::string out;
  std::string resume;
  std::shared_ptr<std::string> gripper;
  bool or_resume = false;
  bool overwrite = false;
  bool control_after = false;
  int processes = 1;
};

// Of a run whose cem.score is not the metric's.
std::unique_ptr<Judge> JudgeOf(const RunConfig& config) {
  constexpr std::string_view kProgram = "judge:";
  std::string name = config.cem.score;
  if (name.starts_with(kProgram)) name.erase(0, kProgram.size());
  return MakeJudge(
      name, {config.metric, AtEqualMass(), {}, config.seed, config.threads, &ThrowIfInterrupted});
}

// Of a run with cem.refine_steps.
TriangleMesh Refined(const TriangleMesh& mesh, const RunConfig& config, const BoundingBox& within,
                     std::uint64_t seed) {
  DescentOptions options;
  options.steps = config.cem.refine_steps;
  options.budget.hausdorff = config.cem.refine_hausdorff;
  return RefinedSolid(mesh, config.metric, options, within, seed);
}

RunResult Start(const TrainFlags& flags, RunObserver* console, const RunParts& parts,
                const ShapeModelMaker& make) {
  const RunConfig config = ConfigOf(flags.run);
  WarnOfLengths(config.metric);
  const OldRun old_run = flags.overwrite   ? OldRun::kReplace
                         : flags.or_resume ? OldRun::kGoOn
                                           : OldRun::kRefuse;
  return StartRun(config, flags.out, old_run, console, parts, make);
}

void Run(const TrainFlags& flags, const RunParts& parts, const ShapeModelMaker& make) {
  ConsoleObserver console;
  const std::string folder = flags.resume.empty() ? flags.out : flags.resume;
  try {
    const RunResult result = flags.resume.empty() ? Start(flags, &console, parts, make)
                                                  : ResumeRun(flags.resume, &console, make, parts);
    std::printf("%s", StatisticsTable(result.stages, result.control).c_str());
    std::printf("run: %s\n", folder.c_str());
    const fs::path stl = RunFolder{folder}.Stl();
    if (fs::exists(stl)) std::printf("least graspable objects, mm: %s\n", stl.string().c_str());
  } catch (const Interrupted&) {
    if (RunFolder{folder}.HoldsARun()) {
      spdlog::warn("stopped; go on with: antigrasp train --resume {}", folder);
    }
    throw;
  }
}

void Train(const TrainFlags& flags) {
  if (flags.resume.empty() == flags.out.empty()) {
    throw InputError("train needs a folder", "command line",
                     "--out RUN for a new run or --resume RUN to go on");
  }
  if (!flags.resume.empty() &&
      (!flags.run.config.empty() || !flags.run.overrides.empty() || !flags.run.gripper.empty())) {
    throw InputError("--resume with a configuration", "command line",
                     "--resume RUN alone: a run goes on with the settings it began with");
  }
  const auto same = [&]() -> std::vector<std::string> {
    if (!flags.resume.empty()) return {"--resume " + flags.resume};
    return SameForAll(ConfigOf(flags.run));
  };
  const auto run = [&](const ShapeModelMaker& make, RunParts parts) {
    if (flags.control_after) parts.run_beside = {};
    Run(flags, parts, make);
  };
  RunAsJob(flags.processes, same, &ThrowIfInterrupted, &JudgeOf, &Refined, run);
}

}  // namespace

void AddTrainCommand(CLI::App* app) {
  const auto flags = std::make_shared<TrainFlags>();
  CLI::App* command = app->add_subcommand(kTrain.name, kTrain.description);
  command->add_option("CONFIG", flags->run.config, "configuration (TOML); without one, defaults");
  command->add_option("--out", flags->out, "folder of the new run");
  command->add_option("--resume", flags->resume, "go on with the run in this folder");
  command->add_flag("--or-resume", flags->or_resume, "go on with a run of these settings in --out");
  command->add_flag("--overwrite", flags->overwrite, "delete a run that --out holds");
  command->add_option("--set", flags->run.overrides, "override settings; may be repeated")
      ->type_name("KEY=VALUE");
  flags->gripper = AddGripperFlag(command, "Options");
  command->add_option("--seed", flags->run.seed, "same as --set run.seed=");
  command->add_option("--threads", flags->run.threads, "same as --set run.threads=");
  AddProcesses(command, &flags->processes);
  command->add_flag("--control-after", flags->control_after, "the control when the run is done");
  command->add_option("--device", flags->run.device, "same as --set run.device=");
  command->add_option("--mode", flags->run.mode,
                      "same as --set cem.mode=: " + Alternatives(ChoiceNames<EpisodeMode>()));
  CLI::Option* from =
      command->add_option("--from", flags->run.start,
                          "same as --set run.start=, and takes model.* from these networks");
  CLI::Option* fine_tune =
      command->add_flag("--fine-tune", flags->run.fine_tune,
                        "train the networks of --from on in episode 0: same as run.fine_tune=true");
  command->add_flag("--from-scratch", flags->run.from_scratch, "train episode 0: no run.start")
      ->excludes(from, fine_tune);
  command->callback([flags] {
    TakeConfigFromSettings(&flags->run);
    flags->run.gripper = *flags->gripper;
    Train(*flags);
  });
}

}  // namespace antigrasp
