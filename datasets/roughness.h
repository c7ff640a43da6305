#pragma once

#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Dihedral angles of a mesh: over the edges between two faces the turn from one face's normal to
// the other's (0 = flat, whichever way it bends), each edge weighted by its length, so that the
// slivers of marching cubes with their arbitrary normals hardly count. Curved surfaces turn less an
// edge on finer meshes: compare meshes of one resolution. Faces without area are left out; all 0
// without an edge. O(F log F); indices in range.
struct DihedralAngles {
  static constexpr double kFlat = 2.0, kCrease = 30.0, kStep = 0.25;  // degrees

  double flat = 0.0;    // share of the length below kFlat
  double crease = 0.0;  // above kCrease
  // Share of the length at i kStep, [0, 180]: an angle in between goes to both neighbours so that
  // its mean stays. Sum 1.
  std::vector<double> spread;
};
DihedralAngles DihedralAnglesOf(const TriangleMesh& mesh);

// Their mean, degrees.
double MeanDihedralAngle(const TriangleMesh& mesh);

// Of many shapes together, each weighing the same, however large it is or finely cut. At least one.
DihedralAngles MeanOf(const std::vector<DihedralAngles>& shapes);

// Wasserstein-1 distance of two spreads, degrees: how far an edge's angle moves on the mean if one
// becomes the other with the least turning. It has the unit of the angles, no bins or scale to
// choose, and sees how far they move, not only that they do. Below the exact one by at most kStep.
double DihedralDistance(const DihedralAngles& a, const DihedralAngles& b);

}  // namespace antigrasp
