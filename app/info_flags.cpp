#include "antigrasp/app/info_flags.h"

#include "antigrasp/core/error.h"

namespace antigrasp {

void InfoFlags::RefuseTable() const {
  if (csv) {
    throw InputError("no table of " + path, "--csv",
                     "the folder of a run, of perturbed objects or of trials, a checkpoint or "
                     "scores.csv");
  }
}

void AddInfo(CLI::App* app, void (*describe)(const InfoFlags& flags)) {
  const auto flags = std::make_shared<InfoFlags>();
  CLI::App* command = app->add_subcommand("info", "Say what a file or folder is and holds");
  command
      ->add_option("FILE", flags->path,
                   "SDF file, checkpoint, mesh, scores.csv, or the folder of a run, of perturbed "
                   "objects, of trials or of pairs")
      ->required();
  command->add_flag("--csv", flags->csv,
                    "its means with their intervals as a table (docs/formats.md), no text");
  command->add_option("--control", flags->control,
                      "of a run: the run to compare with, instead of its own control");
  command->callback([flags, describe] { describe(*flags); });
}

}  // namespace antigrasp
