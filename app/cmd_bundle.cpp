#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/bundle/bundle_folder.h"

namespace antigrasp {

void AddBundleCommand(CLI::App* app) {
  const auto flags = std::make_shared<BundleRequest>();
  CLI::App* command = app->add_subcommand(
      "bundle", "Write objects for simulators: meshes, convex parts that keep the dents, physics");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder of the bundles and bundle.csv")->required();
  AddOverwrite(command, &flags->overwrite);
  AddChoice(command, "--for", &flags->target, "which files");
  AddChoice(command, "--scale", &flags->scale,
            "min-extent: to --min-extent; egad: EGAD's rule for a --gripper (panda unless named); "
            "true: as it is, in --units");
  AddUnits(command, &flags->units, ", with --scale true");
  const auto gripper = AddGripperFlag(command, "Options");
  const OptionFlags options = AddOptions<BundleOptions>(command, "Options");
  AddThreads(command, &flags->threads);
  command->callback([flags, gripper, options] {
    flags->gripper = *gripper;
    flags->options = GivenOptions<BundleOptions>(options);
    ConsoleObserver console;
    const BundleReport report = WriteBundles(*flags, &console);
    for (const std::string& warning : report.warnings) spdlog::warn("{}", warning);
    std::fputs(report.text.c_str(), stdout);
  });
}

}  // namespace antigrasp
