#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/trial_flags.h"
#include "antigrasp/datasets/import_request.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/judge/make_judge.h"
#include "antigrasp/judge/pair_dataset.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {
namespace {

struct MakeFlags {
  PriorSetOptions options;
  std::string out;
  int processes = 1;
};

void Make(const MakeFlags& flags, WorkShare* share) {
  ConsoleObserver console;
  WritePriorSet(flags.out, flags.options, console.Phase("making " + flags.options.kind), share);
  if (Helps(share)) return;
  std::printf("%s: %s\n", flags.out.c_str(), PriorSetText(flags.options).c_str());
}

struct PairFlags : PairRequest {
  ProtocolName protocol = ProtocolName::kSixWays;
};

void Pair(const PairFlags& flags, const TypedTrial& typed, const MetricFlags& metric_flags) {
  const Protocol protocol = ProtocolOf(flags.protocol);
  const MetricOptions metric = metric_flags.Resolve();
  MetricOptions of_trial = metric;
  const PhysicsTrialOptions trial = TrialOptionsOf(protocol, typed, &of_trial, AtEqualMass());
  RequireOptionsUsed(protocol, trial.physics.tip.shape, typed);
  ConsoleObserver console;
  const PairReport report = WritePairDataset(flags, metric, of_trial, trial, &console);
  for (const std::string& warning : report.warnings) Warn(warning);
  std::fputs(report.text.c_str(), stdout);
}

void AddPairCommand(CLI::App* dataset) {
  const auto flags = std::make_shared<PairFlags>();
  CLI::App* pair = dataset->add_subcommand(
      "pair", "Write objects before and after a change with grasps and labels, to train on");
  pair->add_option("BEFORE", flags->before, "a mesh, a folder of meshes or an SDF file")
      ->required();
  pair->add_option("AFTER", flags->after, "the same objects changed; paired by name")->required();
  pair->add_option("--out", flags->out, "folder (docs/formats.md)")->required();
  AddOverwrite(pair, &flags->overwrite);
  AddChoice(pair, "--protocol", &flags->protocol,
            "of the trial; objects of 50 g where no other "
            "mass is given (--mass 0: each its own)");
  pair->add_option("--train", flags->train, "share of the objects to train on")
      ->check(NumberIn(0.0, 1.0))
      ->capture_default_str();
  pair->add_option("--val", flags->val, "to validate on; the others are the test")
      ->check(NumberIn(0.0, 1.0))
      ->capture_default_str();
  pair->add_option("--license", flags->license, "of the data, for datasheet.md");
  pair->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  AddThreads(pair, &flags->threads);
  const auto trial = AddTrialFlags(pair);
  const auto metric = std::make_shared<MetricFlags>(pair);
  pair->callback([flags, pair, trial, metric] { Pair(*flags, TypedOf(*pair, *trial), *metric); });
}

void AddResolution(CLI::App* command, int* resolution) {
  command
      ->add_option("--resolution", *resolution,
                   "nodes of a grid along a side; a run needs its model.resolution")
      ->check(CLI::Range(16, 256))
      ->capture_default_str();
}

}  // namespace

void AddDatasetCommand(CLI::App* app, const JobRunner& job) {
  CLI::App* dataset = app->add_subcommand(
      "dataset", "Make a prior set, import one from mesh files, or pair objects");
  dataset->require_subcommand(1);

  const auto make_flags = std::make_shared<MakeFlags>();
  CLI::App* make = dataset->add_subcommand("make", "Make a synthetic set of SDF grids");
  make->add_option("KIND", make_flags->options.kind, Alternatives(PriorSetKinds()))
      ->required()
      ->check(CLI::IsMember(PriorSetKinds()));
  make->add_option("--count", make_flags->options.count, "shapes to make")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  make->add_option("--seed", make_flags->options.seed, "random seed")->capture_default_str();
  AddResolution(make, &make_flags->options.resolution);
  make->add_option("--grafts", make_flags->options.grafts, "of a shape's two, those left on it")
      ->check(CLI::Range(0, 2))
      ->capture_default_str();
  AddThreads(make, &make_flags->options.threads);
  AddProcesses(make, &make_flags->processes);
  make->add_option("--out", make_flags->out, ShapeFileKinds())->required();
  make->callback([make_flags, job] {
    job(make_flags->processes, [&](WorkShare* share) { Make(*make_flags, share); });
  });

  const auto request = std::make_shared<ImportRequest>();
  CLI::App* imported = dataset->add_subcommand(
      "import", "Turn meshes (" + Alternatives(ReadableExtensions(), ".") +
                    ") into SDF grids, or take grids of other programs (.npy, .npz, .vti)");
  imported->add_option("INPUT", request->inputs, "meshes or grids, files or folders")->required();
  imported->add_option("--out", request->out, ShapeFileKinds())->required();
  imported->add_option("--report", request->report, "CSV with one row per mesh or grid");
  AddChoice(imported, "--scale", &request->options.scale,
            "set: one factor for all, which leaves out what is far larger than the others; each: "
            "every object as large as the grid allows");
  AddUnits(imported, &request->options.units, ", for sets of one factor");
  AddResolution(imported, &request->options.resolution);
  AddChoice(imported, "--sign", &request->meaning.sign,
            "of grids whose file does not say it (positive inside, if it is not told here)");
  imported
      ->add_option("--spacing", request->meaning.spacing,
                   "of their nodes, in the unit of their values; default: the file's, else 1/n")
      ->check(NumberIn(1e-12, 1e12));
  AddThreads(imported, &request->options.threads);
  const auto processes = std::make_shared<int>(1);
  AddProcesses(imported, processes.get());
  imported->callback([request, processes, job] {
    job(*processes, [&](WorkShare* share) {
      request->options.share = share;
      ConsoleObserver console;
      std::fputs(RunImport(*request, console.Phase("importing")).c_str(), stdout);
    });
  });
  AddPairCommand(dataset);
}

}  // namespace antigrasp
