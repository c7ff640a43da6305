#pragma once

#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/render/render_mesh.h"

namespace antigrasp {

// Rows of objects as one picture, side by side, each as large as RenderMesh makes it. Rows may have
// different lengths; null is left white. Tiles are rendered on `threads` threads (0 = all) with the
// same pixels for any number.
Image ContactSheet(const std::vector<std::vector<const TriangleMesh*>>& rows, const View& view,
                   int threads = 0, const ProgressFn& progress = nullptr);

}  // namespace antigrasp
