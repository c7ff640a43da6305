#pragma once

#include <string>
#include <vector>

namespace antigrasp {

// A library by its headers and by what runs. One is empty where only the other says its version:
// headers without a library, libraries whose headers do not tell.
struct LibraryVersion {
  std::string name, compiled, linked;
};

// Of the commands on meshes; those that the build has.
std::vector<LibraryVersion> GeometryLibraries();

// "Eigen 3.4.0, HDF5 1.10.9 (compiled against 1.10.8)".
std::string LibrariesText(const std::vector<LibraryVersion>& libraries);

}  // namespace antigrasp
