#pragma once

#include <cstddef>

#include "antigrasp/mesh/triangle_mesh.h"

// What the print check leaves to rounding. People draw walls of 0.8 mm and faces of 45 degrees
// exactly, files move them to either side of the limit: the same solid must pass wherever it lies
// and in whatever format. `rounding` is by how much a coordinate may be off (RoundedBy), in the
// unit of the mesh or of the limit.
namespace antigrasp {

// By how much a length may miss its limit: 1e-4 of it, 0.08 um of a wall, plus what two faces and
// the extent that gives the scale may have moved.
double LengthSlack(double limit, double rounding);

// By how much, in radians, a face may miss the angle it was drawn with: 1e-4 (0.006 degrees), plus
// the turn of a plane whose three corners moved; at most
// 3 degrees, also for a face without area.
double AngleSlack(const TriangleMesh& mesh, std::size_t face, double rounding);

}  // namespace antigrasp
