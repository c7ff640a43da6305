#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/datasets/mesh_layout.h"

namespace antigrasp {

// What is to be imported of files and folders.
struct ImportSources {
  std::vector<FoundMesh> meshes;
  std::vector<std::pair<std::string, std::string>> skipped;  // path and why
  std::string layouts;  // "DIR: layout of YCB, 3 objects\n"; a line a folder of a known one
};

// Every file once, sorted by path, so that the set depends neither on the order in which the file
// system lists it nor on that of the arguments. InputError for a missing path.
ImportSources FindImportSources(const std::vector<std::filesystem::path>& inputs);

// What to call them, and InputError when one of them would be written over.
std::vector<std::string> ImportNames(const std::vector<FoundMesh>& meshes,
                                     const std::filesystem::path& out);

}  // namespace antigrasp
