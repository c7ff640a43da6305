#pragma once

#include <string>
#include <vector>

#include "antigrasp/bundle/object_bundle.h"

// The text of the files of a bundle. Meshes lie beside them: NAME.stl, NAME_part_00.stl, ...
namespace antigrasp {

// MJCF for MuJoCo 2.2.2 to 3.14: one free body with explicit inertia; the mesh is drawn (group 2),
// the parts collide (group 3). Their friction goes before that of what touches them (priority 1).
std::string MjcfText(const ObjectBundle& bundle);
// The scene of pinch_scene.h: the box of friction 0.14 falls, that of 0.16 stays.
std::string MjcfSelfCheck();

// URDF: one link, a collision element a part. Friction as Bullet reads it: it multiplies, so what
// touches the object has 1.
std::string UrdfText(const ObjectBundle& bundle);
// The two boxes as a script for PyBullet: a URDF holds no scene.
std::string BulletSelfCheck();

// SDFormat 1.9: model.sdf and its model.config, one link, a collision a part. What touches the
// object has friction 1: DART and ODE take the smaller of two, Bullet their product.
std::string SdformatText(const ObjectBundle& bundle);
std::string SdformatConfig(const ObjectBundle& bundle);
std::string SdformatSelfCheck();  // a world

// USD's text format, meshes and all: a rigid body, drawn by one Mesh, which collides by another one
// a part (convexHull). PhysX takes the smaller friction of a pair.
std::string UsdText(const ObjectBundle& bundle);
std::string UsdSelfCheck();

// What is in the folder, units, errors of the parts, what was checked.
std::string BundleReadme(const ObjectBundle& bundle, BundleTarget target);

struct TextFile {
  std::string name;
  std::string text;
};
// All of them but the meshes, for a target.
std::vector<TextFile> TextFiles(const ObjectBundle& bundle, BundleTarget target);

}  // namespace antigrasp
