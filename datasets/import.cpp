#include "antigrasp/datasets/import.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/core/spool.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/datasets/import_sources.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/mesh/pass_mesh.h"
#include "antigrasp/mesh/repair.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// One file on its way through the import.
struct Item {
  ImportedMesh report;
  bool usable = false;
  double extent = 0.0;  // longest side of the bounding box, in the unit of the file
};

std::string Sentence(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

void Refuse(const std::string& why, Item* item) {
  item->usable = false;
  item->report.status = "refused";
  item->report.detail = why;
}

void PassFields(Passer& pass, Item& item) {
  pass(item.report.path, item.report.status, item.report.detail, item.report.nodes, item.usable,
       item.extent);
}

struct ReadMesh {
  Item item;
  TriangleMesh mesh;  // empty unless it is usable
};
void PassFields(Passer& pass, ReadMesh& read) { pass(read.item, read.mesh); }

ReadMesh ReadItem(const FoundMesh& source, LengthUnit units) {
  Item item;
  item.report.path = source.path;
  try {
    MeshFile file = ReadMeshFile(source.path);
    std::vector<std::string> changes = file.notes;
    TriangleMesh read = InUnit(std::move(file), units);
    if (source.scale != 1.0) read = Transformed(read, source.scale, Eigen::Vector3d::Zero());
    RepairResult repaired = Repair(read);
    changes.insert(changes.end(), repaired.actions.begin(), repaired.actions.end());
    if (repaired.accepted()) {
      item.usable = true;
      item.report.status = changes.empty() ? "accepted" : "repaired";
      item.report.detail = Sentence(changes);
      item.extent = Bounds(repaired.mesh).Extent().maxCoeff();
      return {item, std::move(repaired.mesh)};
    }
    Refuse(repaired.refusal, &item);
  } catch (const InputError& error) {
    Refuse(std::string("not readable: ") + error.what(), &item);
  }
  return {item, {}};
}

// Meshes on disk, by number.
class MeshSpool {
 public:
  MeshSpool(const fs::path& beside, std::size_t count) : spool_(beside), places_(count) {}
  void Put(std::size_t i, const TriangleMesh& mesh) {
    places_[i] = {mesh.vertices.size(), mesh.faces.size(),
                  spool_.Append(mesh.vertices.data(), Bytes(mesh.vertices))};
    spool_.Append(mesh.faces.data(), Bytes(mesh.faces));
  }
  TriangleMesh Get(std::size_t i) const {
    TriangleMesh mesh;
    mesh.vertices.resize(places_[i].vertices);
    mesh.faces.resize(places_[i].faces);
    const std::uint64_t at = places_[i].at;
    spool_.Read(at, mesh.vertices.data(), Bytes(mesh.vertices));
    spool_.Read(at + Bytes(mesh.vertices), mesh.faces.data(), Bytes(mesh.faces));
    return mesh;
  }

 private:
  struct Place {
    std::size_t vertices = 0, faces = 0;
    std::uint64_t at = 0;
  };
  template <typename T>
  static std::size_t Bytes(const std::vector<T>& values) {
    return values.size() * sizeof(T);
  }
  Spool spool_;
  std::vector<Place> places_;
};

// Leaves out what is too large for the set; the longest side of the others.
double LongestOfTheSet(std::vector<Item>* items) {
  std::vector<double> extents;
  for (const Item& item : *items) {
    if (item.usable) extents.push_back(item.extent);
  }
  const double median = DiscretePercentile(extents, 50.0);
  double longest = 0.0;
  for (Item& item : *items) {
    if (!item.usable) continue;
    if (item.extent <= kLargestByMedian * median) {
      longest = std::max(longest, item.extent);
      continue;
    }
    char why[200];
    std::snprintf(why, sizeof why,
                  "too large for the set: %.3g long, the median is %.3g and at most %g times that "
                  "is taken; another unit? --scale each takes every size",
                  item.extent, median, kLargestByMedian);
    Refuse(why, &item);
  }
  return longest;
}

SdfGrid ToGrid(const TriangleMesh& mesh, double scale, int resolution) {
  SdfGrid grid = UnitCubeGrid(resolution);
  MeshToSdf(Transformed(mesh, scale, -scale * Bounds(mesh).Center()), &grid);
  return grid;
}

bool HasInside(const std::vector<float>& values) {
  return *std::max_element(values.begin(), values.end()) > 0.0f;
}

std::string TooThin(const ImportOptions& options) {
  const std::string n = std::to_string(options.resolution);
  return "too thin for the grid: no node of " + n + "^3 is inside" +
         (options.scale == ImportScale::kSet ? ", at the scale of the whole set" : "");
}

std::size_t CountUsable(const std::vector<Item>& items, const std::string& where) {
  const auto usable =
      std::count_if(items.begin(), items.end(), [](const Item& i) { return i.usable; });
  if (usable > 0) return static_cast<std::size_t>(usable);
  throw InputError("none of " + std::to_string(items.size()) + " mesh files is usable; " +
                       items.front().report.path + ": " + items.front().report.detail,
                   where, "at least one closed mesh in one piece that does not cross itself");
}

std::string Joined(const std::vector<fs::path>& inputs) {
  std::vector<std::string> names;
  for (const fs::path& input : inputs) names.push_back(input.string());
  return Sentence(names);
}

// Every file read and repaired; usable meshes wait in the spool (of a rank that helps: nullptr).
std::vector<Item> ReadAll(const std::vector<FoundMesh>& sources, const ImportOptions& options,
                          MeshSpool* spool, const ProgressFn& progress) {
  std::vector<Item> items(sources.size());
  StreamShared(
      options.share, std::ssize(sources), options.threads,
      [&](std::int64_t i) { return ReadItem(sources[static_cast<std::size_t>(i)], options.units); },
      [&](std::int64_t i, ReadMesh read) {
        const auto slot = static_cast<std::size_t>(i);
        items[slot] = std::move(read.item);
        if (items[slot].usable) spool->Put(slot, read.mesh);
      },
      progress);
  return items;
}

// The grids of the usable meshes, in the order of the items, wait in the spool; what has nothing
// inside is refused. `mesh_of` an item by number, `scale_of` an item.
template <typename MeshOf, typename Scale>
void GridAll(const MeshOf& mesh_of, const Scale& scale_of, const ImportOptions& options,
             std::vector<Item>* items, Spool* grids, const ProgressFn& progress) {
  const double spacing = UnitCubeGrid(options.resolution).spacing;
  StreamShared(
      options.share, std::ssize(*items), options.threads,
      [&](std::int64_t i) -> std::vector<float> {
        const Item& item = (*items)[static_cast<std::size_t>(i)];
        if (!item.usable) return {};
        return ToGrid(mesh_of(static_cast<std::size_t>(i)), scale_of(item), options.resolution)
            .values;
      },
      [&](std::int64_t i, const std::vector<float>& values) {
        if (values.empty()) return;
        Item& item = (*items)[static_cast<std::size_t>(i)];
        item.report.nodes = scale_of(item) * item.extent / spacing;
        if (!HasInside(values)) return Refuse(TooThin(options), &item);
        grids->Append(values.data(), values.size() * sizeof(float));
      },
      progress);
}

// Grid by grid: how many there are is known only now, and SDF files begin with it.
void WriteGrids(const Spool& grids, const std::vector<Item>& items,
                const std::vector<std::string>& names, int resolution, ShapeSetWriter* writer) {
  SdfGrid grid = UnitCubeGrid(resolution);
  const std::size_t bytes = grid.values.size() * sizeof(float);
  std::uint64_t place = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].usable) continue;
    grids.Read(place, grid.values.data(), bytes);
    writer->Add(names[i], grid);
    place += bytes;
  }
  writer->Commit();
}

}  // namespace

std::vector<ImportedMesh> ImportMeshes(const std::vector<fs::path>& inputs, const fs::path& out,
                                       const ImportOptions& options, const ProgressFn& progress,
                                       std::string* layouts) {
  AG_CHECK(options.resolution > 2.0 * kFreeCells, "a grid larger than its border");
  ImportSources found = FindImportSources(inputs);
  if (layouts != nullptr) *layouts = std::move(found.layouts);
  std::vector<FoundMesh>& sources = found.meshes;
  const std::string where = Joined(inputs);
  if (sources.empty()) {
    throw InputError("no mesh file", where, Alternatives(ReadableExtensions(), "*."));
  }
  const std::vector<std::string> names = ImportNames(sources, out);
  RequireShapeSetName(out);

  // Reading and gridding count as one step each.
  const auto count = std::ssize(sources);
  const auto report_from = [&](std::int64_t offset) -> ProgressFn {
    if (!progress) return nullptr;
    return [&, offset](std::int64_t done, std::int64_t) { progress(offset + done, 2 * count); };
  };
  const bool helps = Helps(options.share);
  std::optional<Spool> grids;
  std::optional<MeshSpool> meshes;
  if (!helps) {
    grids.emplace(out.string() + ".grids");
    meshes.emplace(out.string() + ".meshes", sources.size());
  }
  std::vector<Item> items = ReadAll(sources, options, meshes ? &*meshes : nullptr, report_from(0));
  if (!helps) {
    CountUsable(items, where);
    sources = {};  // the reports have the paths
  }
  TellAll(options.share, &items);

  const double room = (options.resolution - 2.0 * kFreeCells) / options.resolution;
  const bool one = options.scale == ImportScale::kSet;
  const double scale = one ? room / LongestOfTheSet(&items) : 0.0;
  const auto scale_of = [&](const Item& item) { return one ? scale : room / item.extent; };
  // One that helps reads a mesh again: those that were read lie with rank 0.
  const auto mesh_of = [&](std::size_t i) {
    return helps ? ReadItem(sources[i], options.units).mesh : meshes->Get(i);
  };
  GridAll(mesh_of, scale_of, options, &items, grids ? &*grids : nullptr, report_from(count));
  if (helps) return {};

  ShapeSet about{.kind = "import"};
  if (one) about.side = 1.0 / scale;
  about.provenance = "imported from " + where +
                     (one ? ", scaled by " + FormatDouble(scale) : ", each scaled to the cube");
  ShapeSetWriter writer(out, about, CountUsable(items, where));
  WriteGrids(*grids, items, names, options.resolution, &writer);
  std::vector<ImportedMesh> reports;
  for (Item& item : items) reports.push_back(std::move(item.report));
  for (const auto& [path, why] : found.skipped) reports.push_back({path, "skipped", why, 0.0});
  return reports;
}

}  // namespace antigrasp
