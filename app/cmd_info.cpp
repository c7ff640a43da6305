#include <cstdio>
#include <filesystem>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/info_flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/judge/pair_tables.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_text.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/quality/score_table.h"
#include "antigrasp/trial/trial_folders.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void DescribePerturbed(const InfoFlags& flags) {
  const std::vector<PerturbRow> rows = ReadPerturbTable(fs::path(flags.path) / "perturb.csv");
  const PerturbMeans means = MeansOf(rows);
  if (flags.csv) {
    std::fputs(PerturbMeansCsv(means).c_str(), stdout);
    return;
  }
  const std::string failed = FailedText(rows);
  std::printf("%s: perturbed objects\n%s\n%s", flags.path.c_str(), PerturbMeansText(means).c_str(),
              failed.empty() ? "" : ("failed: " + failed + "\n").c_str());
}

void DescribeScores(const InfoFlags& flags) {
  const PerturbMeans means = MeansOf(PairsOf(ReadScores(flags.path)));
  if (flags.csv) {
    std::fputs(PerturbMeansCsv(means).c_str(), stdout);
  } else {
    std::printf("%s: %s", flags.path.c_str(), ScoreMeansText(means).c_str());
  }
}

void Describe(const InfoFlags& flags) {
  const fs::path path(flags.path);
  if (IsHdf5(path) || IsShapeSet(path)) {
    flags.RefuseTable();
    std::printf("%s: %s", path.c_str(), ShapeFileText(ReadShapeSetInfo(path)).c_str());
  } else if (fs::is_regular_file(path) && IsMeshFile(path)) {
    flags.RefuseTable();
    std::printf("%s: %s", path.c_str(), MeshFileText(ReadMeshFile(path)).c_str());
  } else if (fs::is_regular_file(path / "perturb.csv")) {
    DescribePerturbed(flags);
  } else if (fs::is_regular_file(path / "means.csv")) {
    const std::string text = TrialFolderText(flags.path);
    std::fputs((flags.csv ? ReadFile(path / "means.csv") : text).c_str(), stdout);
  } else if (fs::is_regular_file(path / "grasps_before.csv")) {
    flags.RefuseTable();
    std::fputs(PairFolderText(path).c_str(), stdout);
  } else if (fs::is_regular_file(path) && path.extension() == ".csv") {
    DescribeScores(flags);
  } else {
    BecomeNetworks();
  }
}

}  // namespace

void AddInfoCommand(CLI::App* app) { AddInfo(app, Describe); }

}  // namespace antigrasp
