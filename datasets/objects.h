#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// One object named on the command line, however it came: a mesh file, a mesh in a folder, a grid.
struct InputObject {
  std::string name;
  TriangleMesh mesh;
  std::string status;  // "ok", or why there is no usable solid ("open: 12 boundary edges", ...)
  std::string note;    // what was repaired, or what is unusual; may be empty
  bool ok() const { return status == "ok"; }
};

// Mesh files, folders (searched recursively) and SDF files, in the order given, sorted inside a
// folder. A mesh is usable when it is closed and oriented after repair. InputError for a missing
// path, for a file of unknown kind, for an unreadable file that was named itself, and for no object
// at all; an unreadable mesh inside a folder is an object with that status. `limit`: at most the
// first so many; 0 = all.
std::vector<InputObject> LoadObjects(const std::vector<std::string>& inputs, int threads,
                                     const ProgressFn& progress = nullptr, std::size_t limit = 0);

// A file name for an object's name: path separators become underscores, an extension is dropped.
std::string FileNameOf(const std::string& object_name);

// "12 objects: 10 ok, 1 empty, 1 open: 4 boundary edges".
std::string CountByStatus(const std::vector<InputObject>& objects);

}  // namespace antigrasp
