#include <cstdio>
#include <memory>
#include <type_traits>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/perturb_objects.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "antigrasp/perturb/search_choice.h"

namespace antigrasp {
namespace {

struct PerturbFlags : PerturbRequest {
  int processes = 1;
};

// One subcommand: the options of its own algorithm, those that the paper's three share, and the
// metric's. `subdivide` is the default of --subdivide: what moves vertices within a limit of angles
// needs many of them. `run` is the algorithm.
template <typename Options, typename Run>
void AddMethod(CLI::App* perturb, const JobRunner& job, const std::string& name,
               const std::string& help, SubdivideOptions subdivide, Run run) {
  CLI::App* command = perturb->add_subcommand(name, help);
  const auto flags = std::make_shared<PerturbFlags>();
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder for before/, after/, sheet.png and perturb.csv")
      ->required();
  AddOverwrite(command, &flags->overwrite);
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  AddThreads(command, &flags->threads, "; results do not depend on it");
  AddProcesses(command, &flags->processes);
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
  command->callback([flags, own_flags, metric_flags, bind, subdivide, run, job] {
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
    flags->constants = "seed = " + std::to_string(flags->seed) + "\n\n" + used.Dump();
    if (settings.judges) flags->constants += JudgePool::Lease(settings.judges.get())->Toml();
    flags->gripper = metric_flags->gripper();
    job(flags->processes, [&](WorkShare* share) {
      flags->share = share;
      ConsoleObserver console;
      PerturbObjects(*flags, settings, &console, &Warn,
                     [](const std::string& text) { std::fputs(text.c_str(), stdout); });
    });
  });
}

}  // namespace

void AddPerturbCommand(CLI::App* app, const JobRunner& job) {
  CLI::App* perturb = app->add_subcommand(
      "perturb", "Make objects harder to grasp by moving their vertices (paper, section IV)");
  perturb->require_subcommand(1);
  perturb->footer("antigrasp perturb METHOD --help shows a method's options");
  AddMethod<ExhaustiveOptions>(perturb, job, "exhaustive",
                               "IV-A: every vertex of every antipodal face; small meshes",
                               SubdivideOptions{kAsItIs}, PerturbExhaustively);
  AddMethod<RandomPerturbOptions>(
      perturb, job, "random", "IV-B: random vertices of sampled pairs, normals kept within alpha",
      SubdivideOptions{0.0}, PerturbRandomly);
  AddMethod<RotationOptions>(perturb, job, "rotation",
                             "IV-C: decimate, then turn the faces of sampled pairs apart",
                             SubdivideOptions{kAsItIs}, PerturbByRotation);
  AddMethod<SearchChoice>(perturb, job, "search",
                          "beyond the paper: descent on the metric, normals kept within alpha, or "
                          "search on a judge (--objective) within budgets",
                          SubdivideOptions{0.0}, nullptr);
}

}  // namespace antigrasp
