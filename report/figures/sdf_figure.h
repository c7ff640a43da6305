#pragma once

#include <filesystem>
#include <string>

#include "antigrasp/report/figures/object_picture.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// Figure 2 of the paper: a mesh, what is left of it on a grid of signed distances, and a
// cross-section of the grid. Both meshes and the grid are in one frame.
struct SdfFigure {
  std::string name;
  TriangleMesh original, remeshed;
  SdfGrid grid;
  int axis = 2;           // across which the section is taken: 0, 1, 2
  double position = 0.0;  // of the section on that axis
};

// Three panels; in the section every node is one tile, blue outside and orange inside, the line is
// where the distance is zero, and the scale is that of the grid's frame.
void WriteSdfFigure(const std::filesystem::path& path, const SdfFigure& figure,
                    const FigureOptions& options);

}  // namespace antigrasp
