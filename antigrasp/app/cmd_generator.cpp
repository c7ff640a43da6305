#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/train/episode_loop.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct GeneratorFlags {
  std::string checkpoint;
  std::string out;
};

void WriteGenerator(const GeneratorFlags& flags) {
  const fs::path path = FindNetworks(flags.checkpoint);
  const AtomicFile probe(flags.out);  // refuses an unwritable target before the work
  Checkpoint checkpoint = ReadCheckpoint(path);
  RunConfig config = NetworksFromToml(checkpoint.config, path.string());
  config.device = "cpu";
  GanTrainer trainer = MakeTrainer(config);
  ReadNetworks(path, [&](auto* archive) { trainer.LoadNetworks(archive); });
  checkpoint.shapes = torch::empty({0}, torch::kHalf);  // a prior set may be private, and is large
  checkpoint.losses = torch::empty({0, 0}, torch::kDouble);
  WriteCheckpoint(flags.out, checkpoint, [&](auto* archive) { trainer.SaveNetworks(archive); });
  std::printf("%s: networks of episode %d, %.1f MB\n", flags.out.c_str(), trainer.episode(),
              static_cast<double>(fs::file_size(flags.out)) / 1e6);
}

}  // namespace

void AddGeneratorCommand(CLI::App* app) {
  const auto flags = std::make_shared<GeneratorFlags>();
  CLI::App* command = app->add_subcommand(
      "generator", "Write the networks of a checkpoint alone, float16, to share and start from");
  command->add_option("CKPT", flags->checkpoint, "checkpoint, folder of a run, or name")
      ->required();
  command->add_option("--out", flags->out, "file to write")->required();
  command->callback([flags] { WriteGenerator(*flags); });
}

}  // namespace antigrasp
