#include "antigrasp/report/figure_inputs.h"
#include "antigrasp/quality/object_size.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/perturb/perturb_table.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/report/figures/histogram.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/remesh.h"
#include "antigrasp/trial/trial_folders.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostObjects = 100;  // of a figure; more would not be seen
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

void CheckLabels(const std::vector<std::string>& labels, std::size_t count) {
  if (labels.empty() || labels.size() == count) return;
  throw InputError(std::to_string(labels.size()) + " labels", "--label",
                   std::to_string(count) + ", one each");
}

// The last folder of a path, also when the path ends in a slash or a dot.
std::string FolderName(const std::string& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

std::string DisplayName(const std::string& name) {
  return IsMeshFile(name) ? fs::path(name).replace_extension().string() : name;
}

}  // namespace

std::vector<GraspedObject> GraspedObjects(const std::vector<std::string>& inputs,
                                          const std::vector<std::string>& labels,
                                          const MetricOptions& metric, std::uint64_t seed,
                                          int threads, RunObserver* observer) {
  std::vector<InputObject> objects =
      LoadObjects(ObjectSource(inputs, GridUnit::kOfFiles, UnitToReadIn(metric)), threads,
                  observer->Phase("reading"), kMostObjects + 1);
  if (objects.size() > kMostObjects) {
    throw InputError("too many objects", inputs.front(), "at most 100 in a figure");
  }
  CheckLabels(labels, objects.size());
  std::vector<Graspability> scores = ScoreAll(
      std::ssize(objects),
      [&](std::int64_t i) {
        const InputObject& object = objects[static_cast<std::size_t>(i)];
        return object.ok() ? &object.mesh : nullptr;
      },
      [&](std::int64_t i) { return objects[static_cast<std::size_t>(i)].stream; }, metric, seed,
      threads, observer->Phase("scoring"));
  std::vector<GraspedObject> grasped;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    std::string status = objects[i].ok() ? std::string(Name(scores[i].status)) : objects[i].status;
    if (objects[i].ok()) std::replace(status.begin(), status.end(), '_', ' ');
    grasped.push_back({labels.empty() ? DisplayName(objects[i].name) : labels[i], std::move(status),
                       std::move(objects[i].mesh), std::move(scores[i])});
  }
  return grasped;
}

std::string GraspCaption(int shown, const MetricOptions& metric) {
  char text[160];
  std::snprintf(text, sizeof text,
                "%d most robust of %d sampled grasps, friction cone of %.1f degrees", shown,
                metric.num_grasps, std::atan(metric.friction) * 180.0 / std::numbers::pi);
  return text;
}

std::vector<PairHistory> ReadHistories(const fs::path& path) {
  std::vector<PairHistory> histories;
  for (PerturbHistory& history : ReadPerturbHistory(path)) {
    histories.push_back(
        {std::move(history.object), std::move(history.iteration), std::move(history.pairs)});
  }
  return histories;
}

SdfFigure SdfFigureOf(const std::string& input, int resolution, int threads) {
  InputObject object = LoadObjects({input}, threads, nullptr, 1).front();
  if (!object.ok()) throw InputError(object.name + ": " + object.status, input, "a closed solid");
  SdfFigure figure;
  figure.name = DisplayName(object.name);
  figure.grid = UnitCubeGrid(resolution);
  const BoundingBox box = Bounds(object.mesh);
  const double scale = (1.0 - 2.0 * kFreeCells * figure.grid.spacing) / box.Extent().maxCoeff();
  figure.original = Transformed(object.mesh, scale, -scale * box.Center());
  MeshToSdf(figure.original, &figure.grid);
  figure.remeshed = Remesh(figure.grid).mesh;
  if (figure.remeshed.faces.empty()) {
    throw InputError(object.name + " is too thin: no node of the grid is inside", input,
                     "a thicker object or a higher --resolution");
  }
  return figure;
}

namespace {

struct PerturbedPair {
  std::string name;
  double before = kNone, after = kNone;
};

// Of a folder's perturb.csv, the objects with a result and both numbers: those of perturb's own
// summary.
std::vector<PerturbedPair> ReadPairs(const fs::path& path) {
  RequireFile(path, "perturb.csv of antigrasp perturb --out FOLDER");
  std::vector<PerturbedPair> pairs;
  for (const PerturbRow& row : ReadPerturbTable(path)) {
    const PerturbedPair pair{row.object, row.graspability_before, row.graspability_after};
    const bool scored = std::isfinite(pair.before) && std::isfinite(pair.after);
    if (row.status == "ok" && scored) pairs.push_back(pair);
  }
  return pairs;
}

fs::path MeshOf(const fs::path& folder, const char* part, const std::string& name) {
  return FindMeshFile(folder / part, FileNameOf(name));
}

// The pairs with both meshes whose change is nearest to the median one's, that first.
std::vector<PerturbedPair> MedianPairs(std::vector<PerturbedPair> pairs, const fs::path& folder,
                                       int count) {
  std::erase_if(pairs, [&](const PerturbedPair& pair) {
    return !fs::exists(MeshOf(folder, "before", pair.name)) ||
           !fs::exists(MeshOf(folder, "after", pair.name));
  });
  if (pairs.empty()) return pairs;
  const auto change = [](const PerturbedPair& pair) { return pair.after - pair.before; };
  const auto by_change = [&](const PerturbedPair& a, const PerturbedPair& b) {
    return change(a) < change(b);
  };
  std::stable_sort(pairs.begin(), pairs.end(), by_change);
  const double median = change(pairs[(pairs.size() - 1) / 2]);
  std::stable_sort(pairs.begin(), pairs.end(), [&](const PerturbedPair& a, const PerturbedPair& b) {
    return std::abs(change(a) - median) < std::abs(change(b) - median);
  });
  pairs.resize(std::min(pairs.size(), static_cast<std::size_t>(count)));
  return pairs;
}

std::string Caption(double graspability) {
  char text[32];
  std::snprintf(text, sizeof text, "g = %.5f", graspability);
  return text;
}

FigureRow FigureRowOf(const fs::path& folder, int examples) {
  FigureRow row;
  row.gap = "no object was scored";
  const std::vector<PerturbedPair> pairs = ReadPairs(folder / "perturb.csv");
  for (const PerturbedPair& pair : pairs) {
    row.reference.push_back(pair.before);
    row.values.push_back(pair.after);
  }
  const double mean = MeanWithInterval(row.reference).mean;
  row.reference = Divided(std::move(row.reference), mean);
  row.values = Divided(std::move(row.values), mean);
  for (const PerturbedPair& pair : MedianPairs(pairs, folder, examples)) {
    row.examples.push_back({ReadMesh(MeshOf(folder, "before", pair.name)), Caption(pair.before)});
    row.examples.push_back({ReadMesh(MeshOf(folder, "after", pair.name)), Caption(pair.after)});
  }
  return row;
}

}  // namespace

RowFigure PerturbFigure(const std::vector<std::string>& folders,
                        const std::vector<std::string>& labels, int examples) {
  CheckLabels(labels, folders.size());
  RowFigure figure;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    figure.rows.push_back(FigureRowOf(folders[i], examples));
    figure.rows.back().label = labels.empty() ? FolderName(folders[i]) : labels[i];
  }
  for (int k = 0; k < examples; ++k) {
    figure.titles.insert(figure.titles.end(), {"original", "perturbed"});
  }
  figure.values_name = "perturbed";
  figure.reference_name = "originals";
  figure.axis = "graspability / mean of the originals";
  return figure;
}

TrialFigure TriedFigure(const std::vector<std::string>& folders) {
  const TriedFolders tried = ReadTrialFolders(folders);
  const TrialJudge& judge = tried.judge;
  char text[48];
  std::snprintf(text, sizeof text, "equal mass, %.4g g", 1000.0 * judge.equal_mass);
  TrialFigure figure;
  int fewest = std::numeric_limits<int>::max(), most = 0;
  for (const TrialMean& row : tried.rows) {
    figure.sets.push_back({row.masses == "equal" ? text : row.masses + " mass", row.friction,
                           row.stage, row.held, row.before});
    fewest = std::min(fewest, row.held.count);
    most = std::max(most, row.held.count);
  }
  const std::string objects = fewest == most
                                  ? std::to_string(most)
                                  : std::to_string(fewest) + " to " + std::to_string(most);
  figure.caption = "judge: " + judge.engine + ", protocol " + judge.protocol + ", fingertip " +
                   judge.tip + "; " + objects + " objects, all grasps; 95 % intervals over objects";
  return figure;
}

}  // namespace antigrasp
