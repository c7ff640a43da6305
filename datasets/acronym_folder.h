#pragma once

#include <filesystem>

#include "antigrasp/datasets/mesh_layout.h"

namespace antigrasp {

// Whether there are files of grasps (grasps/*.h5) beside a folder of meshes (meshes/).
bool IsAcronymFolder(const std::filesystem::path& folder);

// An object a file of grasps, called after it: the mesh /object/file at /object/scale, metres a
// unit. Skipped: files that say neither, meshes that are not there (of the published set one in
// ten), meshes that no file names.
FoundMeshes FindAcronymMeshes(const std::filesystem::path& folder);

}  // namespace antigrasp
