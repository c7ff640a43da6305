#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/quality/contact.h"

namespace antigrasp {

// Where the jaws of an opened gripper first touch. Jaw 1 starts at center - opening / 2 * axis and
// moves along +axis, jaw 2 comes from the other side; each goes at most to the centre. nullopt when
// a jaw meets nothing, starts inside the object (its first face is seen from behind) or slips at
// `friction`. The contacts' normal forces are for unit jaw forces along the axis.
std::optional<std::array<Contact, 2>> CloseJaws(const RayScene& scene,
                                                const Eigen::Vector3d& center,
                                                const Eigen::Vector3d& axis, double opening,
                                                double friction);
// The same of jaws whose rays are among those that `near` was made for.
std::optional<std::array<Contact, 2>> CloseJaws(const RayScene& scene, const NearFaces& near,
                                                const Eigen::Vector3d& center,
                                                const Eigen::Vector3d& axis, double opening,
                                                double friction);

// Jaws of one opening that close beside each other, as a grasp's draws do.
struct JawClosing {
  Eigen::Vector3d center;
  Eigen::Vector3d axis;  // unit
  double friction;
};
// contacts[i] of closings[i], bit for bit as above, and no tree of Embree need be there.
void CloseJawsTogether(const RayScene& scene, std::span<const JawClosing> closings, double opening,
                       std::span<std::optional<std::array<Contact, 2>>> contacts);

}  // namespace antigrasp
