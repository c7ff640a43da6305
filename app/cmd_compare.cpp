#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/compared_set.h"
#include "antigrasp/datasets/comparison_table.h"
#include "antigrasp/datasets/objects.h"

namespace antigrasp {
namespace {

struct CompareFlags {
  std::string samples, reference, training, out;
  LengthUnit units = LengthUnit::kM;
  int count = 500, processes = 1;
  SurfaceComparisonOptions options;
};

ComparedSet Read(const std::string& input, const std::string& what, std::size_t least,
                 const CompareFlags& flags) {
  ConsoleObserver console;
  ComparedSet set = ReadComparedSet(input, flags.units, flags.options.threads,
                                    console.Phase("reading the " + what));
  if (!Helps(flags.options.share)) {
    std::fprintf(stderr, "%s: %s\n", what.c_str(), set.counts.c_str());
  }
  RequireShapes(set, least);
  return set;
}

void Compare(const CompareFlags& flags) {
  const bool helps = Helps(flags.options.share);
  if (!flags.out.empty() && !helps) const AtomicFile probe(flags.out);  // refused before the work
  for (const std::string& read : {flags.samples, flags.reference, flags.training}) {
    if (!read.empty()) ObjectSource({read}).RequireNotRead({flags.out});
  }
  ComparedSet samples = Read(flags.samples, "samples", 2, flags);
  ComparedSet reference = Read(flags.reference, "reference", 2, flags);
  ComparedSet training;
  if (!flags.training.empty()) training = Read(flags.training, "training set", 1, flags);
  const std::size_t count = KeepAsMany(flags.count, flags.options.seed, &samples, &reference);
  ConsoleObserver console;
  const SurfaceComparison found =
      CompareSurfaces(samples.meshes, reference.meshes, training.meshes, flags.options,
                      [&console](const std::string& phase) { return console.Phase(phase); },
                      {samples.streams, reference.streams, training.streams});
  if (helps) return;
  const ComparisonTable table(found, count, samples.left_out, reference.left_out);
  if (!flags.out.empty()) WriteFileAtomic(flags.out, table.Csv());
  std::fputs(table.Text().c_str(), stdout);
  for (const std::string& doubt : DoubtsOf(found)) spdlog::warn("{}", doubt);
}

}  // namespace

void AddCompareCommand(CLI::App* app, const JobRunner& job) {
  const auto flags = std::make_shared<CompareFlags>();
  CLI::App* command = app->add_subcommand(
      "compare", "Compare a set of objects with a reference set, on their surfaces");
  command->add_option("SAMPLES", flags->samples, "SDF file or folder of meshes")->required();
  command->add_option("REFERENCE", flags->reference, "the same kind of thing: shapes held out")
      ->required();
  command->add_option("--train", flags->training,
                      "what the samples' generator was trained on: looks for copies");
  command->add_option("--out", flags->out, "the numbers (CSV)");
  AddUnits(command, &flags->units, " (of an SDF file: the side of its cube), for the distances");
  command->add_option("--count", flags->count, "most shapes of either set, drawn at random")
      ->check(CLI::Range(2, 5000))
      ->capture_default_str();
  command->add_option("--points", flags->options.points, "points on a shape's surface")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_option("--normals", flags->options.normals, "weight of normals; 0: compare places")
      ->check(NumberIn(0.0, 100.0))
      ->capture_default_str();
  command->add_option("--seed", flags->options.seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->options.threads, "; the numbers do not depend on it");
  AddProcesses(command, &flags->processes);
  command->footer(
      "Distances are Chamfer distances in metres, the objects' unit being --units; they are "
      "compared as they lie.\ndocs/similarity.md defines every number.");
  command->callback([flags, job] {
    job(flags->processes, [&](WorkShare* share) {
      flags->options.share = share;
      Compare(*flags);
    });
  });
}

}  // namespace antigrasp
