#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/datasets/object_names.h"

namespace antigrasp {

// A mesh that stands for an object.
struct FoundMesh {
  std::string path;
  ObjectOrigin origin;
  double scale = 1.0;  // of its coordinates, where the set says one
};

// The objects of a folder, one mesh each.
struct FoundMeshes {
  std::string layout;  // the known set whose layout it has; empty: every mesh is an object
  std::vector<FoundMesh> objects;
  std::vector<std::pair<std::string, std::string>> skipped;  // path and why
};

// Which known layout the tree has is seen from the tree itself; objects are called after their
// folders. Sources: the readmes of the sets.
//   ACRONYM   meshes/CATEGORY/HASH.obj at the scale of grasps/CATEGORY_HASH_SCALE.h5, an object a
//             file of grasps
//   ShapeNet  SYNSET/ID/models/model_normalized.obj
//   YCB       NAME/google_16k/nontextured.ply, else .stl, textured.obj, finer ones, poisson, tsdf
//   Google Scanned Objects  NAME/meshes/model.obj
// A layout counts when most of the meshes lie in its objects' folders; others are skipped. In any
// other folder (EGAD's is flat) every mesh is an object, called after its file. InputError for a
// folder that cannot be searched.
FoundMeshes FindMeshes(const std::filesystem::path& folder);

}  // namespace antigrasp
