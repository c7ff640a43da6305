#include <cstdio>
#include <map>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/datasets/import.h"
#include "antigrasp/datasets/prior_set.h"

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
  int resolution = 32;
  int threads = 0;
};

void Make(const MakeFlags& flags) {
  ConsoleObserver console;
  WritePriorSet(flags.out, flags.options, console.Phase("making " + flags.options.kind));
  std::printf("%s: %d %s, %d^3, seed %llu\n", flags.out.c_str(), flags.options.count,
              flags.options.kind.c_str(), flags.options.resolution,
              static_cast<unsigned long long>(flags.options.seed));
}

std::string ReportCsv(const std::vector<ImportedMesh>& reports) {
  CsvWriter csv({"path", "status", "detail"});
  for (const ImportedMesh& report : reports) {
    csv.Text(report.path).Text(report.status).Text(report.detail).EndRow();
  }
  return csv.text();
}

void Import(const ImportFlags& flags) {
  const AtomicFile probe(flags.out);
  ConsoleObserver console;
  const std::vector<std::filesystem::path> inputs(flags.inputs.begin(), flags.inputs.end());
  const ImportResult result =
      ImportMeshes(inputs, flags.resolution, flags.threads, console.Phase("importing"));
  std::map<std::string, int> counts;
  for (const ImportedMesh& report : result.reports) {
    ++counts[report.status];
    if (report.status != "accepted") {
      std::printf("%-8s %s: %s\n", report.status.c_str(), report.path.c_str(),
                  report.detail.c_str());
    }
  }
  WriteShapeSet(flags.out, result.set);
  if (!flags.report.empty()) WriteFileAtomic(flags.report, ReportCsv(result.reports));
  std::printf("%s: %zu shapes (%d accepted, %d repaired, %d refused)\n", flags.out.c_str(),
              result.set.grids.size(), counts["accepted"], counts["repaired"], counts["refused"]);
}

}  // namespace

void AddDatasetCommand(CLI::App* app) {
  CLI::App* dataset =
      app->add_subcommand("dataset", "Make a prior set, or import one from mesh files");
  dataset->require_subcommand(1);

  const auto make_flags = std::make_shared<MakeFlags>();
  CLI::App* make = dataset->add_subcommand("make", "Make a synthetic set of SDF grids");
  make->add_option("KIND", make_flags->options.kind, "cylinders, prisms or bottles")
      ->required()
      ->check(CLI::IsMember(PriorSetKinds()));
  make->add_option("--count", make_flags->options.count, "shapes to make")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  make->add_option("--seed", make_flags->options.seed, "random seed")->capture_default_str();
  make->add_option("--threads", make_flags->options.threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  make->add_option("--out", make_flags->out, "SDF file to write (HDF5)")->required();
  make->callback([make_flags] { Make(*make_flags); });

  const auto import_flags = std::make_shared<ImportFlags>();
  CLI::App* import =
      dataset->add_subcommand("import", "Turn STL, OBJ, PLY or OFF meshes into SDF grids");
  import->add_option("MESH", import_flags->inputs, "mesh files or folders")->required();
  import->add_option("--out", import_flags->out, "SDF file to write (HDF5)")->required();
  import->add_option("--report", import_flags->report, "CSV with one row per mesh");
  import->add_option("--threads", import_flags->threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  import->callback([import_flags] { Import(*import_flags);
});
}  // namespace antigrasp

}  // namespace antigrasp
