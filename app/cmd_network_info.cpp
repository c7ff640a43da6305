#include <torch/types.h>

#include <cstdio>
#include <filesystem>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/info_flags.h"
#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/train/run_record.h"
#include "antigrasp/train/statistics_table.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void DescribeCheckpoint(const InfoFlags& flags) {
  const fs::path path(flags.path);
  const Checkpoint checkpoint = ReadCheckpoint(path);
  const std::vector<StageStatistics> rows = StatisticsFromCsv(checkpoint.statistics, flags.path);
  if (flags.csv) {
    std::fputs(KappaCsv(rows, {}).c_str(), stdout);
    return;
  }
  std::printf("%s: antigrasp checkpoint, version %d%s\n", path.c_str(), Checkpoint::kVersion,
              checkpoint.finished ? ", of a finished run" : "");
  std::printf("  trains on   %lld shapes\n", static_cast<long long>(checkpoint.shapes.size(0)));
  if (!rows.empty()) std::printf("\n%s", StatisticsTable(rows, {}).c_str());
  std::printf("\n%s", checkpoint.config.c_str());
}

RunFolder RunAt(const std::string& folder, const std::string& where, const std::string& expected) {
  const RunFolder run{folder};
  if (run.HoldsTables()) return run;
  throw InputError("not the folder of a run", where, expected);
}

void DescribeRun(const InfoFlags& flags, const RunFolder& run) {
  const RunFolder control =
      flags.control.empty() ? RunFolder{run.Control()}
                            : RunAt(flags.control, "--control " + flags.control, "one of a run");
  const std::vector<StageStatistics> rows = LatestStatistics(run);
  if (flags.csv) {
    std::fputs(KappaCsv(rows, LatestStatistics(control)).c_str(), stdout);
    return;
  }
  std::printf("%s: antigrasp run\n", run.root.c_str());
  std::printf("%s", rows.empty() ? "no episode finished yet\n"
                                 : StatisticsTable(rows, LatestStatistics(control)).c_str());
}

void Describe(const InfoFlags& flags) {
  const fs::path path(flags.path);
  constexpr const char* kExpected =
      "an SDF file, a checkpoint, a mesh, scores.csv, or the folder of a run, of perturbed "
      "objects, of trials or of pairs";
  if (!fs::exists(path)) throw InputError("no such file or folder", flags.path, kExpected);
  if (fs::is_directory(path)) {
    DescribeRun(flags, RunAt(flags.path, flags.path, kExpected));
  } else if (IsCheckpoint(path)) {
    DescribeCheckpoint(flags);
  } else {
    if (IsZip(path)) ReadCheckpoint(path);  // says what keeps it from being one
    throw InputError("unknown kind of file", flags.path, kExpected);
  }
}

}  // namespace

void AddNetworkInfoCommand(CLI::App* app) { AddInfo(app, Describe); }

}  // namespace antigrasp
