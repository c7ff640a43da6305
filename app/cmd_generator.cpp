#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/train/share_networks.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct GeneratorFlags {
  std::string checkpoint;
  std::string out;
  bool fold_batch_norm = false;
};

void WriteGenerator(const GeneratorFlags& flags) {
  const fs::path path = FindNetworks(flags.checkpoint);
  RequireNotRead(path, {flags.out});
  { const AtomicFile probe(flags.out); }  // refuses an unwritable target before the work
  const SharedNetworks shared =
      NetworksToShare(ReadCheckpoint(path), path.string(), flags.fold_batch_norm);
  WriteCheckpoint(flags.out, shared.checkpoint);
  std::printf("%s: networks of episode %d, %.1f MB\n", flags.out.c_str(), shared.episode,
              static_cast<double>(fs::file_size(flags.out)) / 1e6);
}

}  // namespace

void AddGeneratorCommand(CLI::App* app) {
  const auto flags = std::make_shared<GeneratorFlags>();
  CLI::App* command = app->add_subcommand(kGenerator.name, kGenerator.description);
  command->add_option("CKPT", flags->checkpoint, "checkpoint, folder of a run, or name")
      ->required();
  command->add_option("--out", flags->out, "file to write")->required();
  command->add_flag("--fold-batch-norm", flags->fold_batch_norm,
                    "put batch normalisation into the weights: the same samples, and training goes "
                    "on without it (train --from FILE --fine-tune)");
  command->callback([flags] { WriteGenerator(*flags); });
}

}  // namespace antigrasp
