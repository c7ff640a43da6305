#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {

inline constexpr int kBottleFamilies = 6;  // wine, beer, water, flask, jar, spray

// Half the cross-section of a solid of revolution about z: points (radius, z) from the axis at the
// bottom, round the outside, to the axis at the top.
struct BottleProfile {
  std::vector<Eigen::Vector2d> outline;
};

// A random bottle of one family, centred on its bounding box, inside the cube of side 1.
BottleProfile SampleBottle(int family, RngStream& rng);

// Exact signed distance to the solid, positive inside, at a distance `radius` from the axis.
double SignedDistance(const BottleProfile& profile, double radius, double z);

}  // namespace antigrasp
