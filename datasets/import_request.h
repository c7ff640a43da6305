#pragma once

#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/import.h"
#include "antigrasp/datasets/shape_set.h"

namespace antigrasp {

struct ImportRequest {
  std::vector<std::string> inputs;  // meshes or grids, files or folders of them
  std::string out;                  // SDF file, .npy, .npz or .vti
  std::string report;               // CSV with one row a mesh or grid; empty: none
  ImportOptions options;            // of meshes
  GridMeaning meaning;              // of grids
};

// ImportMeshes or ImportGrids, whichever the inputs are, and the report. What people are told of
// it. InputError as those, for outputs that are one file or are read, and for a meaning of meshes.
std::string RunImport(const ImportRequest& request, const ProgressFn& progress);

}  // namespace antigrasp
