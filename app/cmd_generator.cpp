#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/make_gan.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct GeneratorFlags {
  std::string checkpoint;
  std::string out;
  bool fold_batch_norm = false;
};

void Write(const fs::path& out, Checkpoint checkpoint, const GanTrainer& trainer) {
  checkpoint.networks = trainer.Networks();
  WriteCheckpoint(out, checkpoint);
  std::printf("%s: networks of episode %d, %.1f MB\n", out.c_str(), trainer.episode(),
              static_cast<double>(fs::file_size(out)) / 1e6);
}

void CheckThatItFolds(const ModelOptions& model, const std::string& origin) {
  if (model.batch_norm && model.block == Block::kPlain) return;
  throw InputError("--fold-batch-norm: networks with model.batch_norm = " +
                       std::string(model.batch_norm ? "true" : "false") +
                       ", model.block = " + ChoiceName(model.block),
                   origin, "batch normalisation and plain blocks");
}

void WriteGenerator(const GeneratorFlags& flags) {
  const fs::path path = FindNetworks(flags.checkpoint);
  RequireNotRead(path, {flags.out});
  const AtomicFile probe(flags.out);  // refuses an unwritable target before the work
  Checkpoint checkpoint = ReadCheckpoint(path);
  RunConfig config = NetworksFromToml(checkpoint.config, path.string());
  config.device = "cpu";
  if (flags.fold_batch_norm) CheckThatItFolds(config.model, path.string());
  GanTrainer trainer = MakeTrainer(config);
  trainer.LoadNetworks(checkpoint.networks, path.string());
  checkpoint.shapes = torch::empty({0}, torch::kHalf);  // a prior set may be private, and is large
  checkpoint.losses = torch::empty({0, 0}, torch::kDouble);
  if (!flags.fold_batch_norm) {
    Write(flags.out, checkpoint, trainer);
    return;
  }
  config.model.batch_norm = false;
  checkpoint.config = ToToml(config);
  GanTrainer folded = MakeTrainer(config);
  folded.TakeFolded(&trainer);
  Write(flags.out, checkpoint, folded);
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
