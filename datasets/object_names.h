#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antigrasp {

// What an object is called unless another one is called so too, and the folder that holds it (of an
// object in an SDF file: the file's path without its extension).
struct ObjectOrigin {
  std::string name;  // "mug.stl", "a/mug.stl", "cylinders-000017"
  std::string folder;
};

// A file name for an object's name: path separators become underscores, an extension is dropped.
std::string FileNameOf(const std::string& object_name);

// The number of an object's random stream, the same alone, in any folder and beside any others:
// HashOf the last part of its own name without the extension. "mug.stl", "a/mug.obj" and "mug_stl",
// the name that DistinctNames makes of the first, share one, as an object before and after a change
// does; a file "mug_stl.obj" has another.
std::uint64_t StreamOf(const std::string& object_name);

// One name an object, no two with the same FileNameOf, so that neither rows of a table nor files
// are mixed up. An object whose name is its own keeps it. Else the extension is written out
// ("mug_stl" beside "mug_obj"), or as many folders come before the name as tell the objects apart
// ("001_brick/google_16k/nontextured.stl"), or, of one object named twice, a number
// ("mug_2.stl"). Depends on the order of the objects for those numbers only.
std::vector<std::string> DistinctNames(const std::vector<ObjectOrigin>& objects);

}  // namespace antigrasp
