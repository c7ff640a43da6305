#pragma once

#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp::bench {

// Intersected cylinders as the episode loop scores them (remeshed from their grids, unit cube).
// About 3,000 faces each at the usual resolution.
std::vector<TriangleMesh> RemeshedCylinders(int count, int resolution = 32);

// The same object scaled as the metric does, its smallest extent 40 mm.
TriangleMesh InMetres(const TriangleMesh& mesh);

}  // namespace antigrasp::bench
