#include <torch/types.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/statistics.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void DescribeCheckpoint(const fs::path& path) {
  const Checkpoint checkpoint = ReadCheckpoint(path);
  std::printf("%s: antigrasp checkpoint, version %d%s\n", path.c_str(), Checkpoint::kVersion,
              checkpoint.finished ? ", of a finished run" : "");
  std::printf("  trains on   %lld shapes\n", static_cast<long long>(checkpoint.shapes.size(0)));
  const std::vector<StageStatistics> rows = StatisticsFromCsv(checkpoint.statistics, path.string());
  if (!rows.empty()) std::printf("\n%s", StatisticsTable(rows, {}).c_str());
  std::printf("\n%s", checkpoint.config.c_str());
}

void DescribeRun(const RunFolder& run) {
  std::printf("%s: antigrasp run\n", run.root.c_str());
  const auto rows_of = [](const RunFolder& folder) {
    return fs::exists(folder.Latest())
               ? StatisticsFromCsv(ReadCheckpoint(folder.Latest()).statistics,
                                   folder.Latest().string())
               : std::vector<StageStatistics>{};
  };
  const std::vector<StageStatistics> rows = rows_of(run);
  if (rows.empty()) {
    std::printf("no episode finished yet\n");
  } else {
    std::printf("%s", StatisticsTable(rows, rows_of({run.Control()})).c_str());
  }
}

void Describe(const std::string& input) {
  const fs::path path(input);
  constexpr const char* kExpected = "an SDF file, a checkpoint, a mesh, or the folder of a run";
  if (!fs::exists(path)) throw InputError("no such file or folder", input, kExpected);
  if (fs::is_directory(path)) {
    const RunFolder run{path};
    if (!run.HoldsARun()) throw InputError("not the folder of a run", input, kExpected);
    DescribeRun(run);
  } else if (IsCheckpoint(path)) {
    DescribeCheckpoint(path);
  } else {
    throw InputError("unknown kind of file", input, kExpected);
  }
}

}  // namespace

void AddNetworkInfoCommand(CLI::App* app) {
  const auto path = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand("info", "Say what a file or run folder is");
  command->add_option("FILE", *path, "SDF file, checkpoint, mesh or run folder")->required();
  command->callback([path] { Describe(*path); });
}

}  // namespace antigrasp
