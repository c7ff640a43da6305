#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "antigrasp/contact/mesh_contact.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// An object as a rigid body, in its own frame: the centre of mass is the origin, the axes are the
// principal axes of inertia. Metres.
struct GrippedBody {
  ContactSolid solid;
  Eigen::Isometry3d from_object;  // from the frame of the mesh to the body's
  double volume;                  // m3
  Eigen::Vector3d inertia;        // principal moments at density 1, m5
  double radius;                  // of the farthest vertex from the centre of mass
};

// `mesh`: closed, outward, metres. Exact integrals over the solid (mesh/mass_properties.h). A body
// without a positive volume and inertia is a broken invariant: ask Inspect() first.
GrippedBody MakeGrippedBody(const TriangleMesh& mesh);

}  // namespace antigrasp
