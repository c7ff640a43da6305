#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/comparison_table.h"
#include "antigrasp/datasets/objects.h"

namespace antigrasp {
namespace {

struct CompareFlags {
  std::string samples, reference, training, out;
  LengthUnit units = LengthUnit::kM;
  int count = 500;
  SurfaceComparisonOptions options;
};

// The usable objects of an input.
struct LoadedSet {
  std::vector<TriangleMesh> meshes;
  std::vector<std::uint64_t> streams;
  int left_out = 0;
};

LoadedSet Load(const std::string& input, const std::string& what, const CompareFlags& flags) {
  ConsoleObserver console;
  std::vector<InputObject> objects =
      LoadObjects({input}, flags.options.threads, console.Phase("reading the " + what));
  LoadedSet set;
  std::vector<std::string> statuses;
  for (InputObject& object : objects) {
    statuses.push_back(object.status);
    if (object.ok() && SurfaceArea(object.mesh) > 0.0) {
      // The whole name: points of two shapes of one set are never drawn alike.
      set.streams.push_back(HashOf(FileNameOf(object.name)));
      set.meshes.push_back(flags.units == LengthUnit::kM
                               ? std::move(object.mesh)
                               : Transformed(object.mesh, MetresPer(flags.units), {0.0, 0.0, 0.0}));
    } else {
      ++set.left_out;
    }
  }
  std::fprintf(stderr, "%s: %s\n", what.c_str(), CountByStatus(statuses).c_str());
  return set;
}

// `count` of the shapes at random, in their order: the first ones of a folder may be of one kind.
// Each draws a lot by its name, and the lowest stay, in whatever order they come.
void KeepAtRandom(std::size_t count, std::uint64_t seed, std::uint64_t number, LoadedSet* set) {
  std::vector<std::pair<std::uint64_t, std::size_t>> lots;
  for (std::size_t i = 0; i < set->streams.size(); ++i) {
    lots.emplace_back(RngStream(seed, "compared shapes", number, set->streams[i]).NextU64(), i);
  }
  std::sort(lots.begin(), lots.end());
  lots.resize(count);
  std::sort(lots.begin(), lots.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  LoadedSet kept{{}, {}, set->left_out};
  for (const auto& [lot, i] : lots) {
    kept.meshes.push_back(std::move(set->meshes[i]));
    kept.streams.push_back(set->streams[i]);
  }
  *set = std::move(kept);
}

void Warn(const SurfaceComparison& found) {
  const double ratio = found.samples.size / found.reference.size;
  if (ratio > 2.0 || ratio < 0.5) {
    spdlog::warn("the samples are {:.3g} times as large as the reference: same unit?", ratio);
  }
  const double nearest = found.sets.within_reference;
  if (nearest < 1.25 * found.reference.floor) {
    spdlog::warn(
        "reference shapes are {:.3g} from their nearest, two samplings of one shape {:.3g}: "
        "coverage, "
        "1-NNA and near-duplicates are largely chance; more --points",
        nearest, found.reference.floor);
  }
}

void Compare(const CompareFlags& flags) {
  if (!flags.out.empty()) const AtomicFile probe(flags.out);  // refuses an unwritable target first
  for (const std::string& read : {flags.samples, flags.reference, flags.training}) {
    if (!read.empty()) ObjectSource({read}).RequireNotRead({flags.out});
  }
  LoadedSet samples = Load(flags.samples, "samples", flags);
  LoadedSet reference = Load(flags.reference, "reference", flags);
  LoadedSet training;
  if (!flags.training.empty()) training = Load(flags.training, "training set", flags);
  const auto require = [](const LoadedSet& set, std::size_t least, const std::string& input) {
    if (set.meshes.size() >= least) return;
    throw InputError(std::to_string(set.meshes.size()) + " solids", input,
                     "at least " + std::to_string(least));
  };
  require(samples, 2, flags.samples);
  require(reference, 2, flags.reference);
  if (!flags.training.empty()) require(training, 1, flags.training);
  const std::size_t count = std::min(
      {static_cast<std::size_t>(flags.count), samples.meshes.size(), reference.meshes.size()});
  KeepAtRandom(count, flags.options.seed, 0, &samples);
  KeepAtRandom(count, flags.options.seed, 1, &reference);
  ConsoleObserver console;
  const SurfaceComparison found =
      CompareSurfaces(samples.meshes, reference.meshes, training.meshes, flags.options,
                      [&console](const std::string& phase) { return console.Phase(phase); },
                      {samples.streams, reference.streams, training.streams});
  const ComparisonTable table(found, count, samples.left_out, reference.left_out);
  if (!flags.out.empty()) WriteFileAtomic(flags.out, table.Csv());
  std::fputs(table.Text().c_str(), stdout);
  Warn(found);
}

}  // namespace

void AddCompareCommand(CLI::App* app) {
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
  command->add_option("--seed", flags->options.seed, "random seed")->capture_default_str();
  command
      ->add_option("--threads", flags->options.threads,
                   "threads; 0 = all; the numbers do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->footer(
      "Distances are Chamfer distances in metres, the objects' unit being --units; they are "
      "compared as they lie.\ndocs/similarity.md defines every number.");
  command->callback([flags] { Compare(*flags); });
}

}  // namespace antigrasp
