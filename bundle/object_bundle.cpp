#include "antigrasp/bundle/object_bundle.h"

#include <cstdio>
#include <utility>

#include "antigrasp/bundle/convex_parts.h"
#include "antigrasp/mesh/mass_properties.h"

namespace antigrasp {

std::string ObjectBundle::PartName(std::size_t i) const {
  char number[24];
  std::snprintf(number, sizeof number, "%02zu", i);
  return name + "_part_" + number;
}

ObjectBundle MakeObjectBundle(const std::string& name, TriangleMesh solid,
                              const BundleOptions& options) {
  ObjectBundle bundle;
  bundle.name = name;
  bundle.mesh = std::move(solid);
  const MassProperties of_one = ComputeMassProperties(bundle.mesh);
  bundle.mass = options.mass > 0.0 ? options.mass : options.density * of_one.volume;
  bundle.center = of_one.center;
  bundle.inertia = bundle.mass / of_one.volume * of_one.inertia;
  bundle.friction = options.friction;
  bundle.cell = CellOf(bundle.mesh);
  PartOptions parts;
  parts.parts = options.parts;
  bundle.parts = ConvexParts(bundle.mesh, parts);
  bundle.errors = MeasureParts(bundle.mesh, bundle.parts, bundle.cell);
  return bundle;
}

}  // namespace antigrasp
