#pragma once

#include <string>

#include "antigrasp/bundle/object_bundle.h"

// The text of the files of a bundle. Meshes lie beside them: NAME.stl, NAME_part_00.stl, ...
namespace antigrasp {

// MJCF for MuJoCo 2.2.2 to 3.14: one free body with explicit inertia; the mesh is drawn (group 2),
// the parts collide (group 3). Their friction goes before that of what touches them (priority 1).
std::string MjcfText(const ObjectBundle& bundle);
// Two boxes of 40 mm and 30 g, each pinched by two balls at 1 N (0.147 is needed to hold it): that
// of friction 0.14 falls, that of 0.16 stays.
std::string MjcfSelfCheck();

// URDF: one link, a collision element a part. Friction as Bullet reads it: it multiplies, so what
// touches the object has 1.
std::string UrdfText(const ObjectBundle& bundle);

// What is in the folder, units, errors of the parts, what was checked.
std::string BundleReadme(const ObjectBundle& bundle, BundleTarget target);

}  // namespace antigrasp
