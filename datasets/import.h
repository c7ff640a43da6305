#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/mesh/length_unit.h"

namespace antigrasp {

// One factor for the whole set (VI-C), which keeps the objects' sizes; or each object as large as
// the cube allows.
enum class ImportScale { kSet, kEach };
constexpr auto ChoicesOf(ImportScale) {
  return std::to_array<Choice<ImportScale>>(
      {{ImportScale::kSet, "set"}, {ImportScale::kEach, "each"}});
}

struct ImportOptions {
  int resolution = 32;
  ImportScale scale = ImportScale::kSet;
  int threads = 0;                    // 0 = all; the set does not depend on it
  LengthUnit units = LengthUnit::kM;  // meshes whose files know theirs are turned into it
  // Whose ranks read, repair and grid the meshes together; those that help write nothing and get no
  // reports.
  WorkShare* share = nullptr;
};

// With one factor for all, an object more than this many times as long as the set's median (lower)
// is left out: it would leave half of the set at most 28 / 5 nodes of 32.
inline constexpr double kLargestByMedian = 5.0;

struct ImportedMesh {
  std::string path;
  std::string status;  // "accepted", "repaired", "refused", "skipped"
  std::string detail;  // how it was repaired or why it was refused or skipped
  double nodes = 0.0;  // length of its longest side on the grid, in distances of nodes; 0: unknown
};

// Mesh files, or folders searched recursively, to one SDF file, whose names are told apart
// (DistinctNames). Every mesh is centred, and scaled so that bounding boxes fit the unit cube
// inside the border. A bad mesh and one of another size than the set are reported, not fatal;
// InputError for a missing path, for no mesh file at all and for no usable mesh. The reports of
// every file, in path order, then of those that were skipped: of a folder in the layout of a known
// set one mesh an object is taken (mesh_layout.h), and `layouts` says of which, a line a folder.
// Meshes and grids wait on disk beside `out`: memory does not grow with their number.
std::vector<ImportedMesh> ImportMeshes(const std::vector<std::filesystem::path>& inputs,
                                       const std::filesystem::path& out,
                                       const ImportOptions& options,
                                       const ProgressFn& progress = nullptr,
                                       std::string* layouts = nullptr);

}  // namespace antigrasp
