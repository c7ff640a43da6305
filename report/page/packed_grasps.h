#pragma once

#include <string>
#include <vector>

#include "antigrasp/quality/graspability.h"

namespace antigrasp {

// Grasps as the page reads them, best first, little endian: a float32 a grasp, its robust quality;
// low and high, float32, of each of 16 columns; then the columns, a uint16 a grasp: low + q / 65535
// * (high - low). Columns: contact points, outward normals, approach, width; lengths in units of
// the mesh, which is metres_per_unit metres. 36 bytes a grasp and 128. A number that is not finite
// is 0.
std::string PackGrasps(std::vector<ScoredGrasp> grasps, double metres_per_unit);

}  // namespace antigrasp
