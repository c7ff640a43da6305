#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "antigrasp/contact/fingertip.h"
#include "antigrasp/contact/mesh_contact.h"

namespace antigrasp {

// What two jaws hold, and how strongly.
struct GripLoad {
  double mass = 0.05;   // kg
  double force = 15.0;  // of each jaw when it is held up, N
};

// Two fingertips that close on one rigid body until it rests between them, without inertia: every
// step is the equilibrium of a body that resists its motion a little (a drag of 3 % of the jaws'
// force at their speed), with exact contacts (mesh_contact.h) and Coulomb friction. A first touch
// outside the friction cone is no loss: the body is pushed, turned and mostly caught.
//
// The step is Moreau's with the drag in the place of the mass: velocities and contact forces by
// projected Gauss-Seidel, the jaws' speed one of the unknowns. Only the weight over the force
// counts, and lengths: some 30 steps an execution, 0.2 ms.
class JawSettling {
 public:
  // `com`: centre of mass; `radius`: of the farthest vertex from it. Mesh frame, metres.
  JawSettling(const Eigen::Vector3d& com, double radius, const Fingertip& tip,
              const GripLoad& load);

  struct Grip {
    bool closed = false;  // both tips press and nothing moves
    bool held = false;    // and it bears its weight in six directions, one after another
    Eigen::Isometry3d object = Eigen::Isometry3d::Identity();  // pose of the mesh at the end
    int steps = 0;
  };
  // `object`: pose of the mesh in the gripper's frame: the origin midway between the fingertips, x
  // from tip 1 to tip 2. `opening`: between the tips' surfaces, m. Const and thread-safe.
  Grip Close(const ContactSolid& solid, const Eigen::Isometry3d& object, double opening,
             double friction) const;

 private:
  Eigen::Vector3d com_;
  double radius_;
  Fingertip tip_;
  GripLoad load_;
};

}  // namespace antigrasp
