#pragma once

#include <array>

#include "antigrasp/quality/contact.h"

namespace antigrasp {

// What a contact's normal says in the force-closure test.
enum class NormalSense {
  kLine,  // its line only: either way may be inward. Dex-Net's default (use_abs_value), for meshes
          // whose normals have no sure sign; it takes a grasp on one face for a pinch
  kOutward,  // outward, as Contact defines it. Dex-Net with use_abs_value=False
};

// Whether two soft-finger contacts hold the object against any wrench, forces without limit: the
// line between the points lies in both friction cones (Nguyen, "Constructing Force-Closure Grasps",
// 1988; Dex-Net cccf933, grasping/quality.py, force_closure). The cones are round and their edges
// belong to them. Forces, slip, torsion and centre of mass play no part, so that this is neither
// necessary nor sufficient for epsilon > 0 with its octagons. False for coincident points and for
// a normal that is zero or not finite.
bool ForceClosure(const std::array<Contact, 2>& contacts, double friction,
                  NormalSense sense = NormalSense::kLine);

}  // namespace antigrasp
