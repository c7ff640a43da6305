#include "antigrasp/app/perturb_output.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <numeric>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/place.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/render/contact_sheet.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSheetColumns = 8;

// More of an object's size than this may not be lost in a file: faces of a hundredth of the size
// would turn by up to 0.2 degrees.
constexpr double kMostLoss = 1e-5;

bool IsOk(const PerturbedObject& item) { return item.Status() == "ok"; }

// STL where it holds the object well enough.
std::string ExtensionFor(const std::string& name, const TriangleMesh& mesh) {
  const double loss = SinglePrecisionLoss(mesh), size = Bounds(mesh).Extent().maxCoeff();
  if (!(loss > kMostLoss * size)) return ".stl";
  spdlog::warn(
      "{}: written as PLY: so far from the origin STL would round coordinates by {:.1g} of their "
      "unit, {:.1g} of the object's size",
      name, loss, loss / size);
  return ".ply";
}

// Also takes away what an earlier call left there in the other format.
void WriteAs(const std::string& extension, const fs::path& path, const TriangleMesh& mesh) {
  WriteMesh(path.string() + extension, mesh);
  fs::remove(path.string() + (extension == ".stl" ? ".ply" : ".stl"));
}

}  // namespace

std::string PerturbedObject::Status() const {
  if (!object.ok()) return "before: " + object.status;
  if (interrupted) return "interrupted";
  return scored.result.failure.empty() ? "ok" : scored.result.failure;
}

PerturbRow RowOf(const PerturbedObject& item) {
  const ScoredPerturbation& s = item.scored;
  const auto count = [](std::int64_t n) { return n < 0 ? std::nan("") : static_cast<double>(n); };
  PerturbRow row{item.object.name, item.Status()};
  row.faces_before = static_cast<double>(item.object.mesh.faces.size());
  row.faces_after = static_cast<double>(s.result.mesh.faces.size());
  row.pairs_before = count(s.pairs_before);
  row.pairs_after = count(s.pairs_after);
  if (item.object.ok() && !item.interrupted) {
    row.graspability_before = s.graspability_before;
    row.graspability_after = s.graspability_after;
    row.difference = s.graspability_after - s.graspability_before;
    row.normal_max_deg = s.normals.largest;
    row.normal_mean_deg = s.normals.mean;
    row.hausdorff_pct = s.change.hausdorff;
    row.chamfer_pct = s.change.chamfer;
    row.volume_change_pct = s.change.volume_change;
    row.center_of_mass_pct = s.change.center_of_mass;
  }
  const auto& refused = s.result.refused;
  row.iterations = count(s.result.iterations);
  row.moved = count(s.result.moved);
  row.no_gain = count(s.result.no_gain);
  row.refused = count(std::accumulate(refused.begin(), refused.end(), std::int64_t{0}));
  return row;
}

PerturbHistory HistoryOf(const PerturbedObject& item) {
  PerturbHistory history{item.object.name, {}, {}, {}};
  for (const PairCount& count : item.scored.result.history) {
    history.iteration.push_back(static_cast<double>(count.iteration));
    history.pairs.push_back(static_cast<double>(count.pairs));
    history.pairs_below_cone.push_back(count.below < 0 ? std::nan("")
                                                       : static_cast<double>(count.below));
  }
  return history;
}

std::string PerturbSummary(const std::vector<PerturbedObject>& objects) {
  std::vector<PerturbRow> rows;
  std::vector<double> seconds;
  for (const PerturbedObject& item : objects) {
    rows.push_back(RowOf(item));
    if (IsOk(item)) seconds.push_back(item.scored.seconds);
  }
  std::string text = PerturbMeansText(MeansOf(rows));
  if (!seconds.empty()) {
    char time[64];
    std::snprintf(time, sizeof time, ", %.2g s of one thread", MeanWithInterval(seconds).mean);
    text += time;
  }
  const std::string failed = FailedText(rows);
  return text + "\n" + (failed.empty() ? "" : "failed: " + failed + "\n");
}

void CheckPerturbFolder(const std::vector<std::string>& inputs, const fs::path& out) {
  if (fs::exists(out) && !fs::is_directory(out)) {
    throw InputError("cannot write into " + out.string(), "--out", "a folder, or nothing there");
  }
  for (const std::string& input : inputs) {
    const fs::path path = fs::absolute(input).lexically_normal();
    const fs::path folder = fs::is_directory(path) ? path : path.parent_path();
    if (!IsMeshFile(path) && !fs::is_directory(path)) continue;
    for (const fs::path& written : {out, out / "before", out / "after"}) {
      if (fs::exists(written) && fs::equivalent(folder, written)) {
        throw InputError("the results would be written over the inputs", "--out " + out.string(),
                         "another folder than that of " + input);
      }
    }
  }
  fs::path parent = fs::absolute(out);
  while (!fs::exists(parent)) parent = parent.parent_path();
  const AtomicFile probe(parent / "perturb.csv");  // refuses what is not writable
}

void WritePerturbedMeshes(const std::vector<PerturbedObject>& objects, const fs::path& out) {
  MakeFolder(out / "before");
  MakeFolder(out / "after");
  for (const PerturbedObject& item : objects) {
    const TriangleMesh& before = item.scored.before;
    if (before.faces.empty()) continue;
    const std::string file = FileNameOf(item.object.name);
    const std::string extension = ExtensionFor(item.object.name, before);
    WriteAs(extension, out / "before" / file, before);
    if (IsOk(item)) WriteAs(extension, out / "after" / file, item.scored.result.mesh);
  }
}

void WritePerturbedSheet(const std::vector<PerturbedObject>& objects, const fs::path& out,
                         int threads) {
  std::vector<std::vector<const TriangleMesh*>> rows(2);
  for (const PerturbedObject& item : objects) {
    if (!IsOk(item) || rows[0].size() == kSheetColumns) continue;
    rows[0].push_back(&item.scored.before);
    rows[1].push_back(&item.scored.result.mesh);
  }
  if (!rows[0].empty()) WritePng(out / "sheet.png", ContactSheet(rows, View{}, threads));
}

}  // namespace antigrasp
