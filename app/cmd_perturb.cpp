#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>
#include <mutex>
#include <type_traits>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/object_notes.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/perturb_folder.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "antigrasp/perturb/search.h"

namespace antigrasp {
namespace {

struct PerturbFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::uint64_t seed = 1;
  bool overwrite = false;
  int threads = 0;
};

// Turns the progress of objects that run at the same time into that of the whole.
class SharedProgress {
 public:
  SharedProgress(std::size_t objects, ProgressFn progress)
      : total_(kSteps * static_cast<std::int64_t>(objects)), progress_(std::move(progress)) {}

  // To be called with growing shares of one object; `at` remembers the last.
  void Report(double share, std::int64_t* at) {
    const auto now = static_cast<std::int64_t>(share * kSteps);
    if (now <= *at) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ += now - *at;
    *at = now;
    progress_(done_, total_);
  }

 private:
  static constexpr std::int64_t kSteps = 100;
  std::mutex mutex_;
  std::int64_t done_ = 0, total_;
  ProgressFn progress_;
};

// What a signal cuts short is marked so, and the objects that are done are kept.
std::vector<PerturbedObject> PerturbAll(std::vector<InputObject> inputs,
                                        const PerturbSettings& settings, int threads,
                                        const ProgressFn& bar) {
  std::vector<PerturbedObject> objects(inputs.size());
  SharedProgress progress(inputs.size(), bar);
  ParallelFor(static_cast<std::int64_t>(inputs.size()), threads, [&](std::int64_t i) {
    PerturbedObject& item = objects[static_cast<std::size_t>(i)];
    item.object = std::move(inputs[static_cast<std::size_t>(i)]);
    if (item.object.unit != 1.0) {  // of an imported set: results keep the unit of its files
      item.object.mesh = Transformed(item.object.mesh, item.object.unit, Eigen::Vector3d::Zero());
    }
    std::int64_t at = 0;
    try {
      if (item.object.ok()) {
        item.scored = PerturbAndScore(item.object.mesh, settings, item.object.stream,
                                      [&](std::int64_t done, std::int64_t total) {
                                        if (InterruptRequested()) throw Interrupted();
                                        // The scores before and after take the rest.
                                        progress.Report(0.99 * double(done) / double(total), &at);
                                      });
      }
      progress.Report(1.0, &at);
    } catch (const Interrupted&) {
      item.interrupted = item.scored.result.mesh.faces.empty();
    }
  });
  return objects;
}

void Perturb(const PerturbFlags& flags, const PerturbSettings& settings,
             const std::string& constants, const std::string& gripper) {
  ConsoleObserver console;
  CheckPerturbFolder(flags.inputs, flags.out);
  const ObjectSource source(flags.inputs);
  for (const std::string& file : PerturbFiles().of_call) {
    RequireNotRead(gripper, {std::filesystem::path(flags.out) / file});
  }
  ResultFolder results(flags.out, PerturbFiles(), source, flags.overwrite);
  auto inputs = LoadObjects(source, flags.threads, console.Phase("reading"));
  WarnOfNotes(inputs);
  WarnOfSizes(inputs, settings.metric);
  const auto objects =
      PerturbAll(std::move(inputs), settings, flags.threads, console.Phase("perturbing"));
  const std::filesystem::path& out = results.path();
  for (const std::string& note : WritePerturbedMeshes(objects, out)) spdlog::warn("{}", note);
  std::vector<PerturbRow> rows;
  std::vector<PerturbHistory> histories;
  for (const PerturbedObject& item : objects) {
    rows.push_back(RowOf(item));
    histories.push_back(HistoryOf(item));
  }
  if (settings.common.history) WriteFileAtomic(out / "history.csv", PerturbHistoryCsv(histories));
  WriteFileAtomic(out / "perturb.toml", constants);
  WritePerturbedSheet(objects, out, flags.threads);
  WriteFileAtomic(out / "summary.csv", PerturbMeansCsv(MeansOf(rows)));
  results.Commit(PerturbCsv(rows));
  for (const PerturbedObject& item : objects) {
    if (item.Status() != "ok") spdlog::warn("{}: {}", item.object.name, item.Status());
  }
  std::fputs(PerturbSummary(objects).c_str(), stdout);
  const bool any = MeansOf(rows).ok > 0;
  if (any) {
    std::printf("meshes before and after, their picture (sheet.png) and perturb.csv in %s\n",
                flags.out.c_str());
  }
  if (InterruptRequested()) throw Interrupted();
  if (!any) {
    throw RuntimeFailure("no object was perturbed: " + results.table().string() + " says why");
  }
}

// One subcommand: the options of its own algorithm, those that the paper's three share, and the
// metric's. `subdivide` is the default of --subdivide: what moves vertices within a limit of angles
// needs many of them. `run` is the algorithm.
template <typename Options, typename Run>
void AddMethod(CLI::App* perturb, const std::string& name, const std::string& help,
               SubdivideOptions subdivide, const Run& run) {
  CLI::App* command = perturb->add_subcommand(name, help);
  const auto flags = std::make_shared<PerturbFlags>();
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder for before/, after/, sheet.png and perturb.csv")
      ->required();
  AddOverwrite(command, &flags->overwrite);
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all; results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  const auto bind = [](OptionTable* table, Options* own, PerturbOptions* common,
                       SubdivideOptions* fine) {
    Bind(table, own);
    if (!std::is_same_v<Options, SearchOptions>) Bind(table, common);
    Bind(table, fine);
  };
  Options default_own;
  PerturbOptions default_common;
  OptionTable defaults;
  SubdivideOptions default_subdivide = subdivide;
  bind(&defaults, &default_own, &default_common, &default_subdivide);
  const OptionFlags own_flags(command, defaults, "Perturbation");
  const auto metric_flags = std::make_shared<MetricFlags>(command);
  command->callback([flags, own_flags, metric_flags, bind, subdivide, run] {
    Options own;
    PerturbSettings settings;
    settings.subdivide = subdivide;
    OptionTable table;
    bind(&table, &own, &settings.common, &settings.subdivide);
    own_flags.Apply(&table);
    RequireSubdivision(settings.subdivide, "--subdivide");
    settings.metric = metric_flags->Resolve();
    settings.seed = flags->seed;
    settings.method = [own, metric = settings.metric, run](const auto&... arguments) {
      return run(own, metric, arguments...);
    };
    Bind(&table, &settings.metric);
    Perturb(*flags, settings, "seed = " + std::to_string(flags->seed) + "\n\n" + table.Dump(),
            metric_flags->gripper());
  });
}

}  // namespace

void AddPerturbCommand(CLI::App* app) {
  CLI::App* perturb = app->add_subcommand(
      "perturb", "Make objects harder to grasp by moving their vertices (paper, section IV)");
  perturb->require_subcommand(1);
  perturb->footer("antigrasp perturb METHOD --help shows a method's options");
  AddMethod<ExhaustiveOptions>(
      perturb, "exhaustive", "IV-A: every vertex of every antipodal face; small meshes",
      SubdivideOptions{kAsItIs},
      [](const ExhaustiveOptions& own, const MetricOptions&, const TriangleMesh& mesh,
         const PairLimits& pairs, const PerturbOptions& common, RngStream* rng,
         const ProgressFn& progress) {
        return PerturbExhaustively(mesh, pairs, common, own, rng, progress);
      });
  AddMethod<RandomPerturbOptions>(
      perturb, "random", "IV-B: random vertices of sampled pairs, normals kept within alpha",
      SubdivideOptions{0.0},
      [](const RandomPerturbOptions& own, const MetricOptions&, const TriangleMesh& mesh,
         const PairLimits& pairs, const PerturbOptions& common, RngStream* rng,
         const ProgressFn& progress) {
        return PerturbRandomly(mesh, pairs, common, own, rng, progress);
      });
  AddMethod<RotationOptions>(
      perturb, "rotation", "IV-C: decimate, then turn the faces of sampled pairs apart",
      SubdivideOptions{kAsItIs},
      [](const RotationOptions& own, const MetricOptions&, const TriangleMesh& mesh,
         const PairLimits& pairs, const PerturbOptions& common, RngStream* rng,
         const ProgressFn& progress) {
        return PerturbByRotation(mesh, pairs, common, own, rng, progress);
      });
  AddMethod<SearchOptions>(
      perturb, "search", "beyond the paper: descent on the metric, normals kept within alpha",
      SubdivideOptions{0.0},
      [](const SearchOptions& own, const MetricOptions& metric, const TriangleMesh& mesh,
         const PairLimits&, const PerturbOptions&, RngStream* rng,
         const ProgressFn& progress) { return PerturbBySearch(mesh, metric, own, rng, progress); });
}

}  // namespace antigrasp
