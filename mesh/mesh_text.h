#pragma once

#include <string>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What Inspect finds in a mesh, a line each with two spaces before it; lengths in its unit.
std::string MeshText(const TriangleMesh& mesh);

}  // namespace antigrasp
