#pragma once

#include <string>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A solid of millimetres as glTF 2.0 in one binary file: metres, y up where the solid's z was, one
// grey material. Where faces meet at less than `crease` (radians) they share a normal, the mean of
// their own by the angle of their corner: balls are smooth, boxes have edges. Single precision; the
// same bytes for the same solid.
std::string GlbBytes(const TriangleMesh& mesh, const std::string& name, double crease);

inline constexpr double kCreaseOfGlb = 0.5235987755982988;  // 30 degrees

}  // namespace antigrasp
