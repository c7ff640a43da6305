#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Moves vertices until every face normal is within `angle` (radians) of the one that the face has
// in `start`. Gauss-Seidel in the manner of position-based dynamics (Mueller et al. 2007): what the
// three corners of a face outside its cone have moved is drawn together towards their mean, by as
// much as brings the normal just inside. (Corners that move alike leave a normal as it was.) In
// order, in sweeps over all faces, until a sweep finds none. All vertices around a sliver move
// together this way, where moves of single vertices are stuck; a face that was turned over comes
// back too. Returns the faces that the last sweep found outside: 0 = done. 0.1 ms a sweep for 2,500
// faces.
int TurnBack(const TriangleMesh& start, const std::vector<Eigen::Vector3d>& start_normals,
             double angle, int sweeps, TriangleMesh* mesh);

// The largest angle between a face normal and the one given for it, radians; pi for a face without
// area.
double LargestTurn(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& start_normals);

}  // namespace antigrasp
