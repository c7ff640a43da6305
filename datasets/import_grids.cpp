#include "antigrasp/datasets/import_grids.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/core/spool.h"
#include "antigrasp/datasets/grid_check.h"
#include "antigrasp/datasets/mesh_folder.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct GridItem {
  ImportedMesh report;
  SdfGrid grid;
};

// The files and, for every grid of all, which it is of which.
struct GridsOfFiles {
  std::vector<std::unique_ptr<const ShapeSetReader>> readers;
  std::vector<std::pair<std::size_t, int>> places;
  std::vector<std::string> names, paths;
};

GridsOfFiles OpenGridFiles(const std::vector<fs::path>& files, const fs::path& out,
                           const GridMeaning& meaning) {
  GridsOfFiles all;
  std::vector<ObjectOrigin> origins;
  for (const fs::path& file : files) {
    std::error_code ignored;
    if (fs::equivalent(file, out, ignored)) {
      throw InputError("would be written over a file to import", out.string(), "another --out");
    }
    all.readers.push_back(std::make_unique<const ShapeSetReader>(file, meaning));
    const ShapeSetInfo &first = all.readers[0]->info(), &info = all.readers.back()->info();
    if (info.n != first.n || info.truncation != first.truncation ||
        std::abs(info.spacing - first.spacing) > 1e-9) {
      throw InputError(
          std::to_string(info.n) + " nodes a side, truncation " + std::to_string(info.truncation),
          file.string(),
          std::to_string(first.n) + " and " + std::to_string(first.truncation) + ", as " +
              files[0].string());
    }
    const std::string folder = fs::path(file).replace_extension().string();
    int number = 0;
    for (std::string& name : all.readers.back()->Names()) {
      all.paths.push_back(file.string() + ", " + name);
      all.places.emplace_back(all.readers.size() - 1, number++);
      origins.push_back({std::move(name), folder});
    }
  }
  all.names = DistinctNames(origins);
  return all;
}

// Longest side of what is inside, in distances of nodes.
double NodesInside(const SdfGrid& grid) {
  int most = 0;
  const std::size_t n = static_cast<std::size_t>(grid.n);
  for (const std::size_t stride : {std::size_t{1}, n, n * n}) {
    int first = grid.n, last = -1;
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
      if (grid.values[i] <= 0.0F) continue;
      const int at = static_cast<int>(i / stride % n);
      first = std::min(first, at);
      last = std::max(last, at);
    }
    most = std::max(most, last - first + 1);
  }
  return most;
}

GridItem ReadGridItem(const ShapeSetReader& file, int number, std::string path) {
  GridItem item{{std::move(path), "accepted", "", 0.0}, file.Grid(number)};
  item.report.nodes = NodesInside(item.grid);
  const auto refuse = [&](const std::string& why) {
    item.report.status = "refused";
    item.report.detail = why;
    item.report.nodes = 0.0;
  };
  if (!std::all_of(item.grid.values.begin(), item.grid.values.end(),
                   [](float value) { return std::isfinite(value); })) {
    refuse("values that are no numbers");
  } else if (BorderInside(item.grid) > 0.5) {
    refuse("inside at the border: another --sign?");
  } else if (const RemeshStatus status = Remesh(item.grid).status; status == RemeshStatus::kEmpty) {
    refuse("no surface: outside everywhere");
  } else if (status != RemeshStatus::kOk) {
    item.report.detail = "no solid: " + std::string(Name(status));
  }
  return item;
}

ShapeSet AboutGrids(const GridsOfFiles& all, const std::vector<fs::path>& files) {
  const ShapeSetInfo& first = all.readers[0]->info();
  ShapeSet about{.kind = first.kind, .truncation = first.truncation};
  about.side = first.side;
  for (const auto& reader : all.readers) {
    if (reader->info().kind != about.kind) about.kind = "import";
    if (reader->info().side != about.side) about.side = 0.0;
  }
  if (files.size() == 1) {
    about.seed = first.seed;
    about.provenance = first.provenance;
    return about;
  }
  about.provenance = "grids of";
  for (std::size_t i = 0; i < files.size(); ++i) {
    about.provenance += (i > 0 ? ", " : " ") + files[i].string();
  }
  return about;
}

}  // namespace

std::vector<fs::path> GridFilesOf(const std::vector<fs::path>& inputs) {
  std::vector<fs::path> grids;
  std::string mesh;
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    if (fs::is_directory(input, ignored)) {
      std::vector<fs::path> found =
          MeshFilesIn(input).empty() ? GridFilesIn(input) : std::vector<fs::path>();
      if (found.empty()) mesh = input.string();
      grids.insert(grids.end(), found.begin(), found.end());
    } else if (fs::exists(input, ignored) && !IsMeshFile(input) && IsShapeSet(input)) {
      grids.push_back(input);
    } else {
      mesh = input.string();
    }
  }
  if (!grids.empty() && !mesh.empty()) {
    throw InputError("no grids beside those of " + grids[0].string(), mesh,
                     "meshes alone or grids alone");
  }
  return grids;
}

std::vector<ImportedMesh> ImportGrids(const std::vector<fs::path>& files, const fs::path& out,
                                      const GridMeaning& meaning, int threads,
                                      const ProgressFn& progress) {
  RequireShapeSetName(out);
  const GridsOfFiles all = OpenGridFiles(files, out, meaning);
  if (all.places.empty()) throw InputError("no grid", files[0].string(), "at least one");
  Spool spool(out.string() + ".grids");
  std::vector<ImportedMesh> reports;
  std::vector<std::string> names;
  SdfGrid shared;
  StreamInOrder(
      std::ssize(all.places), threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        const auto [file, number] = all.places[slot];
        return ReadGridItem(*all.readers[file], number, all.paths[slot]);
      },
      [&](std::int64_t i, GridItem item) {
        if (item.report.status != "refused") {
          spool.Append(item.grid.values.data(), item.grid.values.size() * sizeof(float));
          names.push_back(all.names[static_cast<std::size_t>(i)]);
          if (names.size() == 1) shared = item.grid;
        }
        reports.push_back(std::move(item.report));
      },
      progress);
  if (names.empty()) {
    throw InputError("none of " + std::to_string(reports.size()) + " grids is usable; " +
                         reports[0].path + ": " + reports[0].detail,
                     files[0].string(), "at least one with its border outside");
  }
  // How many are usable is known only now, and files begin with it.
  ShapeSetWriter writer(out, AboutGrids(all, files), names.size());
  const std::size_t bytes = shared.values.size() * sizeof(float);
  for (std::size_t i = 0; i < names.size(); ++i) {
    spool.Read(i * bytes, shared.values.data(), bytes);
    writer.Add(names[i], shared);
  }
  writer.Commit();
  return reports;
}

}  // namespace antigrasp
