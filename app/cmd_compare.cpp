#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/surface_comparison.h"

namespace antigrasp {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct CompareFlags {
  std::string samples, reference, training, out;
  int count = 500;
  SurfaceComparisonOptions options;
};

// The usable objects of an input.
struct LoadedSet {
  std::vector<TriangleMesh> meshes;
  int left_out = 0;
};

LoadedSet Load(const std::string& input, const std::string& what, int threads) {
  ConsoleObserver console;
  std::vector<InputObject> objects =
      LoadObjects({input}, threads, console.Phase("reading the " + what));
  LoadedSet set;
  std::vector<std::string> statuses;
  for (InputObject& object : objects) {
    statuses.push_back(object.status);
    if (object.ok() && SurfaceArea(object.mesh) > 0.0) {
      set.meshes.push_back(std::move(object.mesh));
    } else {
      ++set.left_out;
    }
  }
  std::fprintf(stderr, "%s: %s\n", what.c_str(), CountByStatus(statuses).c_str());
  return set;
}

// `count` of the meshes at random, in their order: the first ones of a folder may be of one kind.
void KeepAtRandom(std::size_t count, std::uint64_t seed, std::uint64_t set,
                  std::vector<TriangleMesh>* meshes) {
  RngStream rng(seed, "compared shapes", set);
  std::vector<TriangleMesh> kept;
  for (std::size_t i = 0; i < meshes->size() && kept.size() < count; ++i) {
    if (rng.Below(meshes->size() - i) < count - kept.size()) {
      kept.push_back(std::move((*meshes)[i]));
    }
  }
  *meshes = std::move(kept);
}

// One line of the result; NaN where a number does not exist.
struct Row {
  const char* name;   // in the file
  const char* label;  // on the screen, with the unit
  double samples, reference;
  double factor = 1.0;  // on the screen: 100 for percent
};

std::vector<Row> Rows(const SurfaceComparison& found, const LoadedSet& samples,
                      const LoadedSet& reference) {
  const auto shapes = static_cast<double>(samples.meshes.size());
  const SetComparison& sets = found.sets;
  const SpreadComparison& spread = found.spread;
  const SetLook &a = found.samples, &b = found.reference;
  std::vector<Row> rows = {
      {"shapes", "shapes", shapes, shapes},
      {"left_out", "left out: no solid", double(samples.left_out), double(reference.left_out)},
      {"size", "size (mean diagonal)", a.size, b.size},
      {"coverage", "coverage (COV), %", sets.coverage, kNone, 100.0},
      {"nna", "1-NN accuracy (1-NNA), %", sets.nna, kNone, 100.0},
      {"matching", "minimum matching distance (MMD)", sets.matching, kNone},
      {"nearest_reference", "to the nearest reference shape", sets.to_reference,
       sets.within_reference},
      {"floor", "two samplings of one shape", a.floor, b.floor},
      {"near_duplicates", "near-duplicates, %", spread.samples.duplicates,
       spread.reference.duplicates, 100.0},
      {"mean_distance", "mean distance of two shapes", spread.samples.mean_distance,
       spread.reference.mean_distance},
      {"diversity", "diversity, by the reference's", spread.diversity, kNone},
      {"vendi", "different shapes (Vendi score)", a.vendi, b.vendi},
      {"roughness", "roughness (dihedral), degrees", a.roughness, b.roughness},
  };
  if (found.memorisation) {
    const Memorisation& m = *found.memorisation;
    rows.push_back({"nearest_training", "to the nearest training shape", m.samples, m.reference});
    rows.push_back(
        {"nearer_to_training", "nearer to it than held-out ones, %", m.nearer, kNone, 100.0});
  }
  return rows;
}

std::string Csv(const std::vector<Row>& rows) {
  CsvWriter csv({"measure", "samples", "reference"});
  for (const Row& row : rows) {
    csv.Text(row.name).NumbersOrGaps({row.samples, row.reference});
    csv.EndRow();
  }
  return csv.text();
}

void Print(const std::vector<Row>& rows) {
  const auto cell = [](const Row& row, double value) -> std::string {
    if (std::isnan(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", row.factor * value);
    return text;
  };
  std::printf("%-36s %10s %10s\n", "", "samples", "reference");
  for (const Row& row : rows) {
    std::printf("%-36s %10s %10s\n", row.label, cell(row, row.samples).c_str(),
                cell(row, row.reference).c_str());
  }
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
  const int threads = flags.options.threads;
  LoadedSet samples = Load(flags.samples, "samples", threads);
  LoadedSet reference = Load(flags.reference, "reference", threads);
  LoadedSet training;
  if (!flags.training.empty()) training = Load(flags.training, "training set", threads);
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
  KeepAtRandom(count, flags.options.seed, 0, &samples.meshes);
  KeepAtRandom(count, flags.options.seed, 1, &reference.meshes);
  ConsoleObserver console;
  const SurfaceComparison found =
      CompareSurfaces(samples.meshes, reference.meshes, training.meshes, flags.options,
                      [&console](const std::string& phase) { return console.Phase(phase); });
  const std::vector<Row> rows = Rows(found, samples, reference);
  if (!flags.out.empty()) WriteFileAtomic(flags.out, Csv(rows));
  Print(rows);
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
      "Distances are Chamfer distances, in the unit of the objects, which are compared "
      "as they lie.\ndocs/similarity.md defines every number.");
  command->callback([flags] { Compare(*flags); });
}

}  // namespace antigrasp
