#include <cstdio>

#include "antigrasp/bundle/bundle_files.h"

namespace antigrasp {
namespace {

std::string Line(const char* format, auto... values) {
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// What each engine needs, and its self-check.
std::string ForEngines(const std::string& name, BundleTarget target) {
  std::string text;
  if (IsFor(target, BundleTarget::kMujoco)) {
    text += "MuJoCo (2.2.2 and 3.14 tried): `" + name +
            ".xml`, to load or to include. Its friction goes before that of what touches it "
            "(priority 1). For grasps set cone=\"elliptic\" and noslip_iterations=\"10\": else "
            "what is held creeps down.\n"
            "Self-check, the left box (friction 0.14) falls, the right one (0.16) stays:\n\n"
            "    python3 -m mujoco.viewer --mjcf=self_check.xml\n\n";
  }
  if (IsFor(target, BundleTarget::kUrdf)) {
    text += "URDF (read by libsdformat 12 and urdf-loader): `" + name +
            ".urdf`. Bullet multiplies the frictions of a pair: give what touches the object 1. In "
            "hand size and metres Bullet's single precision tilts contact normals: build it in "
            "double precision.\n"
            "Self-check for PyBullet, prints how far either box sank:\n\n"
            "    python3 self_check_bullet.py\n\n";
  }
  if (IsFor(target, BundleTarget::kSdformat)) {
    text +=
        "SDFormat 1.9 (read by libsdformat 12): `model.sdf`, with `model.config`. Give what "
        "touches the object friction 1: DART and ODE take the smaller of two, Bullet their "
        "product; the friction cones of DART and ODE are pyramids, which hold up to 1.41 times "
        "more across.\n"
        "Self-check for Gazebo, not tried in it:\n\n"
        "    gz sim -r self_check.sdf\n\n";
  }
  if (IsFor(target, BundleTarget::kUsd)) {
    text += "USD (read by three.js and tinyusdz): `" + name +
            ".usda`, for Isaac Sim and whatever reads UsdPhysics. PhysX takes the smaller friction "
            "of a pair: what touches the object has as much or more, and no combine mode of its "
            "own.\n"
            "Self-check: open self_check.usda and press play; not tried in Isaac Sim.\n\n";
  }
  return text;
}

}  // namespace

std::string BundleReadme(const ObjectBundle& bundle, BundleTarget target) {
  const Eigen::Vector3d extent = 1000.0 * Bounds(bundle.mesh).Extent();
  const Eigen::Vector3d center = 1000.0 * bundle.center;
  std::string text = "# " + bundle.name + "\n\n";
  text += "Metres, kilograms, seconds; the axes and the origin of the object's own file.\n\n";
  text += Line("- size %.2f x %.2f x %.2f mm\n", extent.x(), extent.y(), extent.z());
  text += Line(
      "- mass %.6g kg, centre of mass (%.4f, %.4f, %.4f) mm: exact integrals over the mesh, "
      "written in every file\n",
      bundle.mass, center.x(), center.y(), center.z());
  text += Line("- friction %g between the object and what touches it\n", bundle.friction);
  text += Line(
      "- convex parts: %zu, which cover %.2f %% of the volume too much and miss %.2f %%; Hausdorff "
      "distance %.2f mm, deepest dent covered %.2f mm (a cell of a 32^3 grid is %.2f mm)\n",
      bundle.parts.size(), 100.0 * bundle.errors.covered, 100.0 * bundle.errors.missing,
      1000.0 * bundle.errors.hausdorff, 1000.0 * bundle.errors.dent, 1000.0 * bundle.cell);
  text += "\n" + bundle.name + ".stl is what is seen, " + bundle.name +
          "_part_*.stl is what collides.\n\n";
  return text + ForEngines(bundle.name, target);
}

}  // namespace antigrasp
