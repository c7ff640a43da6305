#pragma once

#include <Eigen/Core>
#include <string>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What a mesh is. Words as in trimesh: watertight = closed, winding consistent = oriented,
// volume = a printable solid.
struct MeshReport {
  bool finite = false;             // every vertex finite, every index in range
  bool closed = false;             // every edge has exactly two faces ("watertight")
  bool manifold = false;           // and every vertex one fan of faces
  bool orientable = false;         // faces can be turned to agree across edges
  bool oriented = false;           // they do agree ("winding consistent")
  bool outward = false;            // closed, oriented, every component outward but the voids
  bool self_intersecting = false;  // only tested when asked for; false otherwise
  int degenerate_faces = 0;        // repeated vertex or zero area
  int components = 0;              // connected by edges
  int voids = 0;                   // of them: closed, and inside an odd number of others
  int overlapping = 0;  // of them: meeting another one; only when self-intersection is asked for
  int boundary_edges = 0;
  int nonmanifold_edges = 0;  // with more than two faces
  int genus = 0;              // of a closed, manifold, orientable single component; else 0
  double volume = 0.0;
  double area = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();

  // Printable: one closed, manifold, outward, non-self-intersecting component with volume > 0,
  // maybe with voids in it.
  bool IsSolid() const {
    return finite && manifold && closed && outward && !self_intersecting && degenerate_faces == 0 &&
           components - voids == 1 && volume > 0.0;
  }
};

// Whether every vertex is finite and every index in range.
bool IsFinite(const TriangleMesh& mesh);

// Examines any mesh, however broken; never throws on geometry. The self-intersection test is
// about 1 ms for 2,500 faces, the rest about as much. Several components: see NestingDepths().
MeshReport Inspect(const TriangleMesh& mesh, bool check_self_intersection = true);

// The first thing that keeps the mesh from being a solid, in plain words; "" when it is one. This
// alone decides what is usable, after Repair(); docs/repair.md lists all that it says.
std::string WhyNotSolid(const MeshReport& report);

}  // namespace antigrasp
