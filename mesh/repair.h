#pragma once

#include <string>
#include <vector>

#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A mesh as near to a solid as safe repairs bring it, and what was done.
struct RepairResult {
  TriangleMesh mesh;
  MeshReport report;                 // of the repaired mesh, self-intersection included
  std::vector<std::string> actions;  // "removed 3 degenerate faces", "turned inside out", ...
  std::string refusal;               // why it is not a solid (WhyNotSolid); "" = accepted
  bool accepted() const { return refusal.empty(); }
};

// Merges duplicate vertices, drops degenerate and duplicate faces and those that cancel between
// parts, flips slivers away, makes the winding agree and outward (inward around a void), unites
// pieces that overlap. Never invents surface: an open or self-intersecting mesh is refused with the
// reason. The mesh is to be in its file's own coordinates: what counts as rounding grows with them.
RepairResult Repair(const TriangleMesh& mesh);

}  // namespace antigrasp
