#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "antigrasp/bundle/bundle_options.h"
#include "antigrasp/bundle/convex_part.h"
#include "antigrasp/bundle/part_errors.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// An object as simulators want it: metres, kilograms, its own axes and origin.
struct ObjectBundle {
  std::string name;  // a file name; XML escapes it
  TriangleMesh mesh;
  std::vector<ConvexPart> parts;
  PartErrors errors;  // lengths in metres
  double cell = 0.0;  // CellOf, metres
  double friction = 0.0;
  double mass = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // about it, along the object's axes; kg m2

  std::string PartName(std::size_t i) const;  // "mug_part_07"
};

// `solid`: closed and outward, in metres. A second or so, most of it the parts.
ObjectBundle MakeObjectBundle(const std::string& name, TriangleMesh solid,
                              const BundleOptions& options);

}  // namespace antigrasp
