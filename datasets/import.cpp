#include "antigrasp/datasets/import.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/repair.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// Grid cells between the largest bounding box and each side of the unit cube.
constexpr double kClearance = 2.0;

struct Source {
  fs::path path;
  std::string name;  // relative to the folder it was found in
};

// One file on its way through the import; `mesh` is empty once it is refused.
struct Item {
  TriangleMesh mesh;
  ImportedMesh report;
  bool usable = false;
};

void AddFolder(const fs::path& folder, std::vector<Source>* sources) {
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    if (!it->is_regular_file(ignored) || !IsMeshFile(it->path())) continue;
    sources->push_back({it->path(), it->path().lexically_relative(folder).generic_string()});
  }
  if (error) {
    throw InputError("cannot search: " + error.message(), folder.string(), "a readable folder");
  }
}

// Every file once, sorted by path, so that the set depends neither on the order in which the file
// system lists it nor on that of the arguments.
std::vector<Source> FindSources(const std::vector<fs::path>& inputs) {
  std::vector<Source> sources;
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    const fs::file_status status = fs::status(input, ignored);
    if (!fs::exists(status)) {
      throw InputError("no such file or folder", input.string(), "mesh files or folders of them");
    }
    if (fs::is_directory(status)) {
      AddFolder(input, &sources);
    } else {
      sources.push_back({input, input.filename().string()});
    }
  }
  std::stable_sort(sources.begin(), sources.end(),
                   [](const Source& a, const Source& b) { return a.path < b.path; });
  std::set<fs::path> seen;
  std::erase_if(sources, [&](const Source& source) {
    std::error_code error;
    const fs::path real = fs::canonical(source.path, error);
    return !seen.insert(error ? source.path : real).second;
  });
  return sources;
}

std::string Sentence(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

Item ReadItem(const fs::path& path) {
  Item item;
  item.report.path = path.string();
  item.report.status = "refused";
  try {
    RepairResult repaired = Repair(ReadMesh(path));
    if (!repaired.accepted()) {
      item.report.detail = repaired.refusal;
      return item;
    }
    item.mesh = std::move(repaired.mesh);
    item.usable = true;
    item.report.status = repaired.actions.empty() ? "accepted" : "repaired";
    item.report.detail = Sentence(repaired.actions);
  } catch (const InputError& error) {
    item.report.detail = std::string("not readable: ") + error.what();
  }
  return item;
}

double LargestExtent(const std::vector<Item>& items) {
  double largest = 0.0;
  for (const Item& item : items) {
    if (item.usable) largest = std::max(largest, Bounds(item.mesh).Extent().maxCoeff());
  }
  return largest;
}

// Refuses the mesh when nothing of it is left on the grid.
SdfGrid ToGrid(Item* item, double scale, int resolution) {
  SdfGrid grid = UnitCubeGrid(resolution);
  MeshToSdf(Transformed(item->mesh, scale, -scale * Bounds(item->mesh).Center()), &grid);
  item->mesh = {};
  if (*std::max_element(grid.values.begin(), grid.values.end()) > 0.0f) return grid;
  const std::string n = std::to_string(resolution);
  item->usable = false;
  item->report.status = "refused";
  item->report.detail =
      "too thin for the grid: no node of " + n + "^3 is inside, at the scale of the whole set";
  return grid;
}

void RequireUsable(const std::vector<Item>& items, const std::string& where) {
  for (const Item& item : items) {
    if (item.usable) return;
  }
  throw InputError("none of " + std::to_string(items.size()) + " mesh files is usable; " +
                       items.front().report.path + ": " + items.front().report.detail,
                   where, "at least one closed mesh in one piece that does not cross itself");
}

std::string Joined(const std::vector<fs::path>& inputs) {
  std::vector<std::string> names;
  for (const fs::path& input : inputs) names.push_back(input.string());
  return Sentence(names);
}

}  // namespace

ImportResult ImportMeshes(const std::vector<fs::path>& inputs, int resolution, int threads,
                          const ProgressFn& progress) {
  AG_CHECK(resolution > 2.0 * kClearance, "a grid larger than its border");
  const std::vector<Source> sources = FindSources(inputs);
  const std::string where = Joined(inputs);
  if (sources.empty()) throw InputError("no mesh file", where, "*.stl, *.obj, *.ply or *.off");

  // Reading and gridding count as one step each.
  const auto count = static_cast<std::int64_t>(sources.size());
  const auto report_from = [&](std::int64_t offset) -> ProgressFn {
    if (!progress) return nullptr;
    return [&, offset](std::int64_t done, std::int64_t) { progress(offset + done, 2 * count); };
  };
  std::vector<Item> items(sources.size());
  ParallelFor(
      count, threads, [&](std::int64_t i) { items[i] = ReadItem(sources[i].path); },
      report_from(0));
  RequireUsable(items, where);

  const double scale = (resolution - 2.0 * kClearance) / resolution / LargestExtent(items);
  std::vector<SdfGrid> grids(items.size());
  ParallelFor(
      count, threads,
      [&](std::int64_t i) {
        if (items[i].usable) grids[i] = ToGrid(&items[i], scale, resolution);
      },
      report_from(count));
  RequireUsable(items, where);

  ImportResult result;
  result.set.kind = "import";
  result.set.provenance = "imported from " + where + ", scaled by " + FormatDouble(scale);
  std::set<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].usable) {
      const bool is_new = names.insert(sources[i].name).second;
      // Two folders may hold the same name.
      result.set.names.push_back(is_new ? sources[i].name : sources[i].path.generic_string());
      result.set.grids.push_back(std::move(grids[i]));
    }
    result.reports.push_back(std::move(items[i].report));
  }
  return result;
}

}  // namespace antigrasp
