#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "antigrasp/contact/contact_patch.h"
#include "antigrasp/contact/tip_pose.h"

namespace antigrasp {

// Adds the corners of the part of a face that lies in front of the pad's front face, nearer than
// margin, or inside the pad. Corners and normal of the face in the object's frame, points in the
// frame of the front face; faces that look away from the pad add nothing. A point's normal is the
// pad's; on the rim of the front face the face's own, as far as the rim's normals reach (those
// between the front face and the sides that meet there): a surface that rises beyond the rim is
// touched by the rim. With `sides`, what has come in through a side of the pad (deeper than 0.25
// mm, and nearer to that side) is touched by the side. Bits of a corner that two faces share are
// the same from both.
void AddPadContacts(const PadPose& pad, double margin,
                    const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal,
                    bool sides, std::vector<PatchPoint>* points);

// Such a point in the object's frame.
SurfaceContact PadContact(const PadPose& pad, const PatchPoint& point);

}  // namespace antigrasp
