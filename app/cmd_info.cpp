#include <cstdio>
#include <filesystem>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/info_flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void DescribeShapeSet(const fs::path& path) {
  const ShapeSetInfo info = ReadShapeSetInfo(path);
  std::printf("%s: antigrasp SDF file, version %d\n", path.c_str(), info.version);
  std::printf("  kind        %s\n  shapes      %d of %d^3\n", info.kind.c_str(), info.count,
              info.n);
  std::printf("  spacing     %g (unit cube), positive inside\n", info.spacing);
  if (info.truncation > 0) {
    std::printf("  values      clamped to +-%g\n", info.truncation);
  } else {
    std::printf("  values      exact distances\n");
  }
  std::printf("  seed        %llu\n  provenance  %s\n", static_cast<unsigned long long>(info.seed),
              info.provenance.c_str());
}

void DescribeMesh(const fs::path& path) {
  std::vector<std::string> notes;
  const TriangleMesh mesh = ReadMesh(path, &notes);
  const MeshReport report = Inspect(mesh);
  const Eigen::Vector3d extent = Bounds(mesh).Extent();
  const std::string refusal = WhyNotSolid(report);
  const auto yes = [](bool value) { return value ? "yes" : "no"; };
  std::printf("%s: mesh, %zu vertices, %zu faces\n", path.c_str(), mesh.vertices.size(),
              mesh.faces.size());
  for (const std::string& note : notes) std::printf("  note               %s\n", note.c_str());
  std::printf("  extent             %g x %g x %g\n", extent.x(), extent.y(), extent.z());
  std::printf("  watertight         %s\n  winding consistent %s\n  outward            %s\n",
              yes(report.closed), yes(report.oriented), yes(report.outward));
  std::printf("  self-intersecting  %s\n  components         %d\n", yes(report.self_intersecting),
              report.components);
  if (report.voids > 0) std::printf("  closed voids       %d of them\n", report.voids);
  std::printf("  genus              %d\n", report.genus);
  std::printf("  volume             %g\n  area               %g\n", report.volume, report.area);
  std::printf("  printable solid    %s\n", refusal.empty() ? "yes" : ("no: " + refusal).c_str());
}

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

// With originals (evaluate --baseline) a table of scores is one of objects before and after.
void DescribeScores(const InfoFlags& flags) {
  std::vector<PerturbRow> rows;
  for (const ScoreRow& score : ReadScores(flags.path)) {
    PerturbRow row{.object = score.object, .status = score.score ? "ok" : score.status};
    if (score.score) row.graspability_after = score.score->graspability;
    for (const auto& [name, value] : score.extras) {
      if (name == "baseline") row.graspability_before = value;
    }
    rows.push_back(std::move(row));
  }
  const PerturbMeans means = MeansOf(rows);
  if (flags.csv) {
    std::fputs(PerturbMeansCsv(means).c_str(), stdout);
    return;
  }
  std::printf("%s: scores, %d of %d objects scored\n", flags.path.c_str(), means.ok, means.objects);
  std::printf("  graspability  %.5f\n", means.graspability_after);
  if (means.reduction.count > 0) {
    std::printf("  originals     %.5f\n  reduction     %.1f +-%.1f %%\n", means.graspability_before,
                means.reduction.mean, means.reduction.half_width);
  }
}

void Describe(const InfoFlags& flags) {
  const fs::path path(flags.path);
  if (IsHdf5(path)) {
    flags.RefuseTable();
    DescribeShapeSet(path);
  } else if (fs::is_regular_file(path) && IsMeshFile(path)) {
    flags.RefuseTable();
    DescribeMesh(path);
  } else if (fs::is_regular_file(path / "perturb.csv")) {
    DescribePerturbed(flags);
  } else if (fs::is_regular_file(path) && path.extension() == ".csv") {
    DescribeScores(flags);
  } else {
    BecomeNetworks();
  }
}

}  // namespace

void AddInfoCommand(CLI::App* app) { AddInfo(app, Describe); }

}  // namespace antigrasp
