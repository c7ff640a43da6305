#include "antigrasp/report/perturbed_report.h"

#include <array>
#include <cmath>
#include <filesystem>

#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/perturb/perturb_table.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// Numbers of perturb.csv that stand beside an object, with what the page calls them.
struct Number {
  double PerturbRow::*value;
  const char* label;
};
constexpr std::array<Number, 12> kNumbers = {{
    {&PerturbRow::difference, "change of graspability"},
    {&PerturbRow::faces_before, "faces before"},
    {&PerturbRow::faces_after, "faces after"},
    {&PerturbRow::pairs_before, "antipodal pairs of faces before"},
    {&PerturbRow::pairs_after, "antipodal pairs of faces after"},
    {&PerturbRow::normal_max_deg, "largest turn of a normal, degrees"},
    {&PerturbRow::normal_mean_deg, "mean turn of a normal, degrees"},
    {&PerturbRow::hausdorff_pct, "Hausdorff distance, % of the diagonal"},
    {&PerturbRow::chamfer_pct, "Chamfer distance, % of the diagonal"},
    {&PerturbRow::center_of_mass_pct, "shift of the centre of mass, % of the diagonal"},
    {&PerturbRow::volume_change_pct, "change of volume, %"},
    {&PerturbRow::moved, "moves"},
}};

// One row of perturb.csv.
struct Row {
  ReportObject object;
  double before, after;  // graspability
};

ScoreSummary ScoreAlone(double graspability) {
  const double nan = std::nan("");
  return {graspability, nan, nan, nan, nan, 0};
}

std::vector<Row> ReadRows(const fs::path& path) {
  std::vector<Row> rows;
  for (const PerturbRow& from : ReadPerturbTable(path)) {
    Row row{{}, from.graspability_before, from.graspability_after};
    row.object.name = from.object;
    row.object.status = from.status;
    for (const Number& number : kNumbers) {
      const std::string text = NumberText(from.*number.value);
      if (!text.empty()) row.object.numbers.emplace_back(number.label, text);
    }
    if (!std::isnan(row.after)) row.object.shape.score = ScoreAlone(row.after);
    row.object.original.emplace().label = "before";
    if (!std::isnan(row.before)) row.object.original->shape.score = ScoreAlone(row.before);
    rows.push_back(std::move(row));
  }
  return rows;
}

// A row has two shapes: 2 i is the one before, 2 i + 1 the one after.
ReportShape* ShapeAt(std::int64_t i, std::vector<Row>* rows) {
  ReportObject& object = (*rows)[static_cast<std::size_t>(i / 2)].object;
  return i % 2 == 0 ? &object.original->shape : &object.shape;
}

fs::path FileAt(std::int64_t i, const fs::path& root, const std::vector<Row>& rows) {
  const std::string& name = rows[static_cast<std::size_t>(i / 2)].object.name;
  return FindMeshFile(root / (i % 2 == 0 ? "before" : "after"), FileNameOf(name));
}

// Reads the meshes that are there and evaluates them as `perturb` did; without `saved` the meshes
// alone. Whether every row scores as the table says.
std::vector<char> ReadAndScore(const fs::path& root, const SavedMetric* saved,
                               const ReportSettings& settings, RunObserver* observer,
                               std::vector<Row>* rows) {
  const SavedMetric unknown;
  const SavedMetric& metric = saved != nullptr ? *saved : unknown;
  std::vector<char> scored(2 * rows->size(), 0), agrees(rows->size(), 1);
  const std::vector<Graspability> scores = ScoreAll(
      std::ssize(scored),
      [&](std::int64_t i) -> const TriangleMesh* {
        const fs::path file = FileAt(i, root, *rows);
        if (!fs::exists(file)) return nullptr;
        ReportShape* const shape = ShapeAt(i, rows);
        shape->mesh = ReadMesh(file);
        if (saved == nullptr) return nullptr;
        scored[static_cast<std::size_t>(i)] = 1;
        return &shape->mesh;
      },
      [&](std::int64_t i) {
        return StreamOf((*rows)[static_cast<std::size_t>(i / 2)].object.name);
      },
      metric.metric, metric.seed, settings.threads, observer->Phase("scoring"));
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (scored[i] == 0) continue;
    const Row& row = (*rows)[i / 2];
    const double expected = i % 2 == 0 ? row.before : row.after;
    ReportShape* const shape = ShapeAt(static_cast<std::int64_t>(i), rows);
    *shape = ShapeOf(std::move(shape->mesh), scores[i]);
    const bool other =
        shape->score && !std::isnan(expected) && shape->score->graspability != expected;
    if (other) agrees[i / 2] = 0;
  }
  return agrees;
}

}  // namespace

bool IsPerturbed(const std::string& path) {
  return fs::is_directory(path) && fs::exists(fs::path(path) / "perturb.csv");
}

Report PerturbedReport(const std::string& folder, const ReportSettings& settings,
                       RunObserver* observer) {
  const fs::path root(folder);
  Report report;
  report.kind = "perturbed";
  report.groups.push_back({"objects", "perturbed objects"});
  std::optional<SavedMetric> saved;
  if (fs::exists(root / "perturb.toml")) {
    saved = ReadSavedMetric((root / "perturb.toml").string());
    report.config = saved->toml;
    report.metric = saved->metric;
    report.provenance.emplace_back("seed", std::to_string(saved->seed));
  } else {
    report.missing.push_back(
        "perturb.toml is not there: the metric's constants are not known and no grasps are shown.");
  }
  std::vector<Row> rows = ReadRows(root / "perturb.csv");
  if (settings.limit > 0 && rows.size() > settings.limit) rows.resize(settings.limit);
  const std::vector<char> agrees =
      ReadAndScore(root, saved ? &*saved : nullptr, settings, observer, &rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ReportObject& object = rows[i].object;
    if (agrees[i] == 0) {
      report.missing.push_back(object.name +
                               " scores otherwise than in perturb.csv: another version wrote it.");
    }
    if (object.status == "ok" && object.shape.mesh.faces.empty()) {
      report.missing.push_back(object.name + " has no mesh in after/.");
    }
    report.objects.push_back(std::move(object));
  }
  return report;
}

}  // namespace antigrasp
