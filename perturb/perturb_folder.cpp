#include "antigrasp/perturb/perturb_folder.h"

#include <algorithm>
#include <cstdio>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/place.h"
#include "antigrasp/perturb/perturb_row.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/quality/sampling_effort.h"
#include "antigrasp/render/contact_sheet.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSheetColumns = 8;

// More of an object's size than this may not be lost in a file: faces of a hundredth of the size
// would turn by up to 0.2 degrees.
constexpr double kMostLoss = 1e-5;

bool IsOk(const PerturbedObject& item) { return item.Status() == "ok"; }

// Why STL does not hold the object well enough; "" when it does.
std::string WhyNotStl(const TriangleMesh& mesh) {
  const double loss = SinglePrecisionLoss(mesh), size = Bounds(mesh).Extent().maxCoeff();
  if (!(loss > kMostLoss * size)) return "";
  char text[160];
  std::snprintf(text, sizeof text,
                "written as PLY: so far from the origin STL would round coordinates by %.1g of "
                "their unit, %.1g of the object's size",
                loss, loss / size);
  return text;
}

std::vector<std::string> WriteMeshes(const std::vector<PerturbedObject>& objects,
                                     const fs::path& out) {
  std::vector<std::string> notes;
  MakeFolder(out / "before");
  MakeFolder(out / "after");
  for (const PerturbedObject& item : objects) {
    const TriangleMesh& before = item.scored.before;
    if (before.faces.empty()) continue;
    const std::string note = WhyNotStl(before);
    if (!note.empty()) notes.push_back(item.object.name + ": " + note);
    const std::string file = FileNameOf(item.object.name) + (note.empty() ? ".stl" : ".ply");
    WriteMesh(out / "before" / file, before);
    if (IsOk(item)) WriteMesh(out / "after" / file, item.scored.result.mesh);
  }
  return notes;
}

void WriteSheet(const std::vector<PerturbedObject>& objects, const fs::path& out, int threads) {
  std::vector<std::vector<const TriangleMesh*>> rows(2);
  for (const PerturbedObject& item : objects) {
    if (!IsOk(item) || rows[0].size() == kSheetColumns) continue;
    rows[0].push_back(&item.scored.before);
    rows[1].push_back(&item.scored.result.mesh);
  }
  if (!rows[0].empty()) WritePng(out / "sheet.png", ContactSheet(rows, View{}, threads));
}

}  // namespace

std::string PerturbedObject::Status() const {
  if (!object.ok()) return "before: " + object.status;
  if (interrupted) return "interrupted";
  return scored.result.failure.empty() ? "ok" : scored.result.failure;
}

PerturbRow RowOf(const PerturbedObject& item) {
  PerturbRow row =
      RowOf(item.object.name, item.Status(), item.scored, item.object.ok() && !item.interrupted);
  row.faces_before = static_cast<double>(item.object.mesh.faces.size());
  return row;
}

std::vector<PerturbRow> RowsOf(const std::vector<PerturbedObject>& objects) {
  std::vector<PerturbRow> rows;
  for (const PerturbedObject& item : objects) rows.push_back(RowOf(item));
  return rows;
}

PerturbHistory HistoryOf(const PerturbedObject& item) {
  return HistoryOf(item.object.name, item.scored.result.history);
}

std::string PerturbSummary(const std::vector<PerturbedObject>& objects) {
  const std::vector<PerturbRow> rows = RowsOf(objects);
  std::vector<double> seconds;
  for (const PerturbedObject& item : objects) {
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

std::string ScoredOnText(const std::vector<PerturbedObject>& objects, const MetricOptions& metric) {
  const auto split = std::count_if(objects.begin(), objects.end(), [](const auto& item) {
    return item.scored.before.faces.size() > item.object.mesh.faces.size();
  });
  std::string text = "graspabilities on " + std::to_string(metric.num_grasps) +
                     " grasps an object, of the meshes in before/ and after/";
  if (split > 0) text += " (" + std::to_string(split) + " subdivided)";
  MetricOptions few = metric;
  RaiseEffortForFew(1, &few);
  if (few.num_grasps == metric.num_grasps) return text;
  return text + "; evaluate takes " + std::to_string(few.num_grasps) + " of up to " +
         std::to_string(kFewObjects) + " objects";
}

ResultFiles PerturbFiles() {
  return {"perturb.csv",
          {"perturb.toml", "history.csv", "summary.csv", "sheet.png"},
          {"before/NAME.stl", "before/NAME.ply", "after/NAME.stl", "after/NAME.ply"}};
}

void CheckPerturbFolder(const std::vector<std::string>& inputs, const fs::path& out) {
  for (const std::string& input : inputs) {
    const fs::path path = fs::absolute(input).lexically_normal();
    const fs::path folder = fs::is_directory(path) ? path : path.parent_path();
    if (!IsMeshFile(path) && !fs::is_directory(path)) continue;
    for (const fs::path& written : {out / "before", out / "after"}) {
      if (fs::exists(written) && fs::equivalent(folder, written)) {
        throw InputError("the results would be written over the inputs", "--out " + out.string(),
                         "another folder than that of " + input);
      }
    }
  }
}

std::vector<std::string> WritePerturbFiles(const std::vector<PerturbedObject>& objects,
                                           const PerturbRecord& record, const fs::path& out) {
  std::vector<std::string> notes = WriteMeshes(objects, out);
  if (record.history) {
    std::vector<PerturbHistory> histories;
    for (const PerturbedObject& item : objects) histories.push_back(HistoryOf(item));
    WriteFileAtomic(out / "history.csv", PerturbHistoryCsv(histories));
  }
  WriteFileAtomic(out / "perturb.toml", record.constants);
  WriteSheet(objects, out, record.threads);
  WriteFileAtomic(out / "summary.csv", PerturbMeansCsv(MeansOf(RowsOf(objects))));
  return notes;
}

}  // namespace antigrasp
