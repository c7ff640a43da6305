#pragma once

#include <string>

#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {

// "mesh, 8 vertices, 12 faces", then what its file says and what Inspect finds in it, a line each
// with two spaces before it; lengths in its unit.
std::string MeshFileText(const MeshFile& file);

}  // namespace antigrasp
