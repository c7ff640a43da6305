#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/datasets/import.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {
namespace {

struct MakeFlags {
  PriorSetOptions options;
  std::string out;
};

struct ImportFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string report;
  ImportOptions options;
};

void Make(const MakeFlags& flags) {
  ConsoleObserver console;
  WritePriorSet(flags.out, flags.options, console.Phase("making " + flags.options.kind));
  std::printf("%s: %d %s, %d^3, seed %llu\n", flags.out.c_str(), flags.options.count,
              flags.options.kind.c_str(), flags.options.resolution,
              static_cast<unsigned long long>(flags.options.seed));
}

std::string ReportCsv(const std::vector<ImportedMesh>& reports) {
  CsvWriter csv({"path", "status", "detail", "nodes"});
  for (const ImportedMesh& report : reports) {
    csv.Text(report.path).Text(report.status).Text(report.detail);
    csv.NumberOrGap(report.nodes > 0.0 ? report.nodes : std::nan("")).EndRow();
  }
  return csv.text();
}

// "longest sides: 12.5 to 28 of 32 nodes, median 20".
void PrintNodes(const std::vector<ImportedMesh>& reports, int resolution) {
  std::vector<double> nodes;
  for (const ImportedMesh& report : reports) {
    if (report.status != "refused") nodes.push_back(report.nodes);
  }
  const auto [least, most] = std::minmax_element(nodes.begin(), nodes.end());
  std::printf("longest sides: %.3g to %.3g of %d nodes, median %.3g\n", *least, *most, resolution,
              DiscretePercentile(nodes, 50.0));
}

void Import(const ImportFlags& flags) {
  { const AtomicFile probe(flags.out); }
  RequireApart({flags.out, flags.report});
  ConsoleObserver console;
  const std::vector<std::filesystem::path> inputs(flags.inputs.begin(), flags.inputs.end());
  const std::vector<ImportedMesh> reports =
      ImportMeshes(inputs, flags.out, flags.options, console.Phase("importing"));
  std::map<std::string, int> counts;
  for (const ImportedMesh& report : reports) {
    ++counts[report.status];
    if (report.status != "accepted") {
      std::printf("%-8s %s: %s\n", report.status.c_str(), report.path.c_str(),
                  report.detail.c_str());
    }
  }
  if (!flags.report.empty()) WriteFileAtomic(flags.report, ReportCsv(reports));
  std::printf("%s: %d shapes (%d accepted, %d repaired, %d refused)\n", flags.out.c_str(),
              counts["accepted"] + counts["repaired"], counts["accepted"], counts["repaired"],
              counts["refused"]);
  PrintNodes(reports, flags.options.resolution);
}

void AddResolution(CLI::App* command, int* resolution) {
  command
      ->add_option("--resolution", *resolution,
                   "nodes of a grid along a side; a run needs its model.resolution")
      ->check(CLI::Range(16, 256))
      ->capture_default_str();
}

}  // namespace

void AddDatasetCommand(CLI::App* app) {
  CLI::App* dataset =
      app->add_subcommand("dataset", "Make a prior set, or import one from mesh files");
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
  make->add_option("--threads", make_flags->options.threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  make->add_option("--out", make_flags->out, "SDF file to write (HDF5)")->required();
  make->callback([make_flags] { Make(*make_flags); });

  const auto import_flags = std::make_shared<ImportFlags>();
  CLI::App* import = dataset->add_subcommand(
      "import", "Turn meshes (" + Alternatives(ReadableExtensions(), ".") + ") into SDF grids");
  import->add_option("MESH", import_flags->inputs, "mesh files or folders")->required();
  import->add_option("--out", import_flags->out, "SDF file to write (HDF5)")->required();
  import->add_option("--report", import_flags->report, "CSV with one row per mesh");
  AddChoice(import, "--scale", &import_flags->options.scale,
            "set: one factor for all, which leaves out what is far larger than the others; each: "
            "every object as large as the grid allows");
  AddResolution(import, &import_flags->options.resolution);
  import->add_option("--threads", import_flags->options.threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  import->callback([import_flags] { Import(*import_flags);
});
}  // namespace antigrasp

}  // namespace antigrasp
