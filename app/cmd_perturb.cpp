#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>
#include <type_traits>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/judge/object_notes.h"
#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/perturb_all.h"
#include "antigrasp/perturb/perturb_folder.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "antigrasp/perturb/search_choice.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

struct PerturbFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::uint64_t seed = 1;
  bool overwrite = false;
  int threads = 0;
};

void Perturb(const PerturbFlags& flags, const PerturbSettings& settings,
             const std::string& constants, const std::string& gripper) {
  ConsoleObserver console;
  CheckPerturbFolder(flags.inputs, flags.out);
  const ObjectSource source(flags.inputs, GridUnit::kOfFiles, UnitToReadIn(settings.metric));
  for (const std::string& file : PerturbFiles().of_call) {
    RequireNotRead(gripper, {std::filesystem::path(flags.out) / file});
  }
  ResultFolder results(flags.out, PerturbFiles(), source, flags.overwrite);
  auto inputs = LoadObjects(source, flags.threads, console.Phase("reading"));
  WarnOfNotes(inputs, &Warn);
  WarnOfSizes(inputs, settings.metric, &Warn);
  const auto objects = PerturbAll(std::move(inputs), settings, flags.threads, InterruptRequested,
                                  console.Phase("perturbing"));
  const std::vector<std::string> notes = WritePerturbFiles(
      objects, {constants, settings.common.history, flags.threads}, results.path());
  for (const std::string& note : notes) spdlog::warn("{}", note);
  const std::vector<PerturbRow> rows = RowsOf(objects);
  results.Commit(PerturbCsv(rows));
  for (const PerturbedObject& item : objects) {
    if (item.Status() != "ok") spdlog::warn("{}: {}", item.object.name, item.Status());
  }
  std::fputs(PerturbSummary(objects).c_str(), stdout);
  const bool any = MeansOf(rows).ok > 0;
  if (any) {
    std::printf("%s\n", ScoredOnText(objects, settings.metric).c_str());
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
               SubdivideOptions subdivide, Run run) {
  CLI::App* command = perturb->add_subcommand(name, help);
  const auto flags = std::make_shared<PerturbFlags>();
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder for before/, after/, sheet.png and perturb.csv")
      ->required();
  AddOverwrite(command, &flags->overwrite);
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->threads, "; results do not depend on it");
  constexpr bool kSearch = std::is_same_v<Options, SearchChoice>;
  const auto bind = [](OptionTable* table, Options* own, PerturbSettings* settings) {
    Bind(table, own);
    if (!kSearch) Bind(table, &settings->common);
    Bind(table, &settings->subdivide);
  };
  Options default_own;
  PerturbSettings default_settings{.subdivide = subdivide};
  OptionTable defaults;
  bind(&defaults, &default_own, &default_settings);
  const OptionFlags own_flags(command, defaults, "Perturbation");
  const auto metric_flags = std::make_shared<MetricFlags>(command);
  command->callback([flags, own_flags, metric_flags, bind, subdivide, run] {
    Options own;
    PerturbSettings settings{.subdivide = subdivide};
    OptionTable table, used;
    bind(&table, &own, &settings);
    own_flags.Apply(&table);
    RequireSubdivision(settings.subdivide, "--subdivide");
    settings.metric = metric_flags->Resolve();
    settings.seed = flags->seed;
    if constexpr (kSearch) {
      RequireUsed(own, [&](const std::string& key) { return own_flags.Typed(key); });
      UseSearch(own, flags->threads, &settings);
      BindUsed(&used, &own);
      Bind(&used, &settings.subdivide);
    } else {
      settings.method = Bound(run, own);
      used = table;
    }
    Bind(&used, &settings.metric);
    std::string constants = "seed = " + std::to_string(flags->seed) + "\n\n" + used.Dump();
    if (settings.judges) constants += JudgePool::Lease(settings.judges.get())->Toml();
    Perturb(*flags, settings, constants, metric_flags->gripper());
  });
}

}  // namespace

void AddPerturbCommand(CLI::App* app) {
  CLI::App* perturb = app->add_subcommand(
      "perturb", "Make objects harder to grasp by moving their vertices (paper, section IV)");
  perturb->require_subcommand(1);
  perturb->footer("antigrasp perturb METHOD --help shows a method's options");
  AddMethod<ExhaustiveOptions>(perturb, "exhaustive",
                               "IV-A: every vertex of every antipodal face; small meshes",
                               SubdivideOptions{kAsItIs}, PerturbExhaustively);
  AddMethod<RandomPerturbOptions>(
      perturb, "random", "IV-B: random vertices of sampled pairs, normals kept within alpha",
      SubdivideOptions{0.0}, PerturbRandomly);
  AddMethod<RotationOptions>(perturb, "rotation",
                             "IV-C: decimate, then turn the faces of sampled pairs apart",
                             SubdivideOptions{kAsItIs}, PerturbByRotation);
  AddMethod<SearchChoice>(perturb, "search",
                          "beyond the paper: descent on the metric, normals kept within alpha, or "
                          "search on a judge (--objective) within budgets",
                          SubdivideOptions{0.0}, nullptr);
}

}  // namespace antigrasp
