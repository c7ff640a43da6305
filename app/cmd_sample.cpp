#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/train/sample_set.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct SampleFlags {
  std::string checkpoint;
  int count = 64;
  std::uint64_t seed = 1;
  std::string out;
  std::string device = "cpu";
  int threads = 0;
  double fairing = -1.0, fairing_power = -1.0;  // below 0: the networks' own
};

void Sample(const SampleFlags& flags) {
  const fs::path path = FindNetworks(flags.checkpoint);
  RequireNotRead(path, {flags.out});
  RequireShapeSetName(flags.out);
  { const AtomicFile probe(flags.out); }  // refuses an unwritable target before the work
  const Checkpoint checkpoint = ReadCheckpoint(path);
  RunConfig config = NetworksFromToml(checkpoint.config, path.string());
  config.device = flags.device;
  config.threads = flags.threads;
  if (flags.fairing >= 0.0) config.gan.fairing = flags.fairing;
  if (flags.fairing_power > 0.0) config.gan.fairing_power = flags.fairing_power;
  const std::unique_ptr<ShapeModel> model = MakeGan(config);
  model->LoadNetworks(checkpoint.networks, path.string());

  ConsoleObserver console;
  WriteSamples(flags.out, model.get(), config.model, path.string(), flags.seed, flags.count,
               console.Phase("sampling"));
  std::printf("%s: %d samples, seed %llu, from %s\n", flags.out.c_str(), flags.count,
              static_cast<unsigned long long>(flags.seed), path.c_str());
}

}  // namespace

void AddSampleCommand(CLI::App* app) {
  const auto flags = std::make_shared<SampleFlags>();
  CLI::App* command = app->add_subcommand(kSample.name, kSample.description);
  command
      ->add_option("CKPT", flags->checkpoint,
                   "checkpoint, folder of a run, or name of pretrained networks")
      ->required();
  command->add_option("--count", flags->count, "grids to sample")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", flags->seed, "seed of the latent vectors")->capture_default_str();
  command->add_option("--out", flags->out, "SDF file to write (HDF5)")->required();
  command
      ->add_option("--fairing", flags->fairing,
                   "few bends in place of many, flat faces and creases: how much, e.g. 0.5 (2 for "
                   "boxes); 0 = as drawn; default: the networks' own gan.fairing")
      ->check(CLI::Range(0.0, 1000.0));
  command
      ->add_option("--fairing-power", flags->fairing_power, "of a bend in that: gan.fairing_power")
      ->check(CLI::Range(0.01, 1.0));
  command->add_option("--device", flags->device, "cpu, cuda, cuda:1")->capture_default_str();
  AddThreads(command, &flags->threads);
  command->callback([flags] { Sample(*flags); });
}

}  // namespace antigrasp
