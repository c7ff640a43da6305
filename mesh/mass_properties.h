#pragma once

#include <Eigen/Core>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Of a solid of density 1, in the mesh's unit.
struct MassProperties {
  double volume = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // of mass: CenterOfMass()
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about the centre, along the mesh's axes
};

// Exact integrals over a closed, outward mesh; voids count as empty. Where the mesh lies costs no
// digits: all is taken about its own centre. Below a volume of about 0 (flat, inside out) nothing
// here means anything.
MassProperties ComputeMassProperties(const TriangleMesh& mesh);

}  // namespace antigrasp
