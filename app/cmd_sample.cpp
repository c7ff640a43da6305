#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/datasets/shape_format.h"
#include "antigrasp/train/sample_set.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void Sample(const SampleRequest& request) {
  ConsoleObserver console;
  const fs::path networks = WriteSamples(request, &console);
  std::printf("%s: %d%s samples, seed %llu, from %s\n", request.out.c_str(), request.count,
              request.unmoved ? " unmoved" : "", static_cast<unsigned long long>(request.seed),
              networks.c_str());
}

}  // namespace

void AddSampleCommand(CLI::App* app) {
  const auto flags = std::make_shared<SampleRequest>();
  CLI::App* command = app->add_subcommand(kSample.name, kSample.description);
  command
      ->add_option("CKPT", flags->networks,
                   "checkpoint, folder of a run, or name of pretrained networks")
      ->required();
  command->add_option("--count", flags->count, "grids to sample")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", flags->seed, "seed of the latent vectors")->capture_default_str();
  command->add_option("--out", flags->out, ShapeFileKinds())->required();
  command
      ->add_option("--fairing", flags->fairing,
                   "few bends in place of many, flat faces and creases: how much, e.g. 0.5 (2 for "
                   "boxes); 0 = as drawn; default: the networks' own gan.fairing")
      ->check(CLI::Range(0.0, 1000.0));
  command
      ->add_option("--fairing-power", flags->fairing_power, "of a bend in that: gan.fairing_power")
      ->check(CLI::Range(0.01, 1.0));
  command->add_option("--device", flags->device, "cpu, cuda, cuda:1")->capture_default_str();
  command->add_flag("--unmoved", flags->unmoved,
                    "without what the loop moved of parts: the pair of each sample");
  AddThreads(command, &flags->threads);
  command->callback([flags] { Sample(*flags); });
}

}  // namespace antigrasp
