#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

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

}  // namespace antigrasp
