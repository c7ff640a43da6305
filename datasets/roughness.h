#pragma once

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Mean dihedral angle, degrees: over the edges between two faces of the turn from one face's normal
// to the other's (0 = flat, whichever way it bends), weighted by the edges' lengths, so that the
// slivers of marching cubes with their arbitrary normals hardly count. It falls with finer meshes
// of the same smooth surface: compare meshes of one resolution. Faces without area are left out; 0
// without an edge. O(F log F); indices in range.
double MeanDihedralAngle(const TriangleMesh& mesh);

}  // namespace antigrasp
