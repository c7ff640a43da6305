#pragma once

#include <Eigen/Core>
#include <array>

namespace antigrasp {

// A soft-finger point contact in the object frame, metres.
struct Contact {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // OUTWARD unit normal of the object
  double normal_force = 1.0;  // max(u . -normal, 0) for a jaw closing along unit u; 1 without u
};

// A parallel-jaw grasp: the two contacts of jaws that close along +axis (first contact) and -axis.
// Other hands say in their GraspModel what the fields mean to them.
struct Grasp {
  std::array<Contact, 2> contacts;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // midpoint of the contacts
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   // unit, from contacts[0] to contacts[1]
  double width = 0.0;                                // distance between the contacts
  // Unit, from the palm to the fingertips, orthogonal to the axis: a free way in for the gripper.
  // Zero when none was looked for.
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();
};

// Two grasps are one when their contacts coincide, whichever jaw holds which.
bool SameGrasp(const Grasp& a, const Grasp& b, double separation);

// The friction cone's tangent frame at a contact whose INWARD unit normal is d: t1 is the object's
// +x axis projected on the tangent plane and normalised, t2 = d x t1. This is the continuum limit
// of Dex-Net's 1000-step search; where d is parallel to x, its SVD basis vector (docs/metric.md).
// Epsilon depends on the frame, because the cone is an octagon.
std::array<Eigen::Vector3d, 2> TangentFrame(const Eigen::Vector3d& d);

// True when a jaw closing along unit u slips: tangential part of u > friction * normal part.
bool Slips(const Eigen::Vector3d& d, const Eigen::Vector3d& u, double friction);

}  // namespace antigrasp
