#pragma once

#include <filesystem>
#include <string>

#include "antigrasp/core/parallel.h"

namespace antigrasp {

struct RemeshRequest {
  std::string input;  // an SDF file
  std::string out;
  std::string format = "obj";
  std::string grids;  // file for the exact distances to these meshes (shape_set.h); empty: none
  bool overwrite = false;
  int threads = 0;
};

struct RemeshedFolder {
  std::string counts;  // "64 objects: 64 ok"
  bool any = false;    // a grid gave a mesh
  std::filesystem::path table;
};

// The grids of an SDF file as meshes of the unit cube in the folder `out`, and remesh.csv
// (docs/formats.md). InputError for what is no SDF file.
RemeshedFolder RemeshIntoFolder(const RemeshRequest& request, const ProgressFn& progress);

}  // namespace antigrasp
