#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/shape_set.h"

namespace antigrasp {

struct ImportedMesh {
  std::string path;
  std::string status;  // "accepted", "repaired", "refused"
  std::string detail;  // how it was repaired or why it was refused
};

struct ImportResult {
  ShapeSet set;                       // the accepted and repaired ones, in path order
  std::vector<ImportedMesh> reports;  // every file, in path order
};

// Mesh files, or folders searched recursively, to one set of grids. The whole set is scaled by one
// factor and every mesh centred, so that the largest bounding box fits the unit cube inside the
// border (VI-C). A bad mesh is reported, not fatal; InputError for a missing path, for no mesh file
// at all and for no usable mesh.
ImportResult ImportMeshes(const std::vector<std::filesystem::path>& inputs, int resolution,
                          int threads, const ProgressFn& progress = nullptr);

}  // namespace antigrasp
