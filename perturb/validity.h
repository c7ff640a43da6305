#pragma once

#include <string>
#include <string_view>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What a change of a mesh must not do. Angles in radians; pi allows everything.
struct MoveLimits {
  double max_turn_from_start = 3.141592653589793;  // of a face's normal, against the first mesh
  double max_turn_per_move = 1.5707963267948966;   // half a turn the other way is inside out
  // Height over longest edge below which a face is degenerate; a face that is flatter from the
  // start may lose half of its height.
  double min_height = 1e-3;
  bool check_intersections = true;
};

enum class MoveVerdict {
  kOk,
  kNotFinite,   // beyond single precision
  kTurned,      // a face turned too far from the start
  kInverted,    // a face turned too far in this move
  kDegenerate,  // a face lost its area or its height
  kIntersects   // a changed face meets another one
};
inline constexpr int kNumMoveVerdicts = 6;
std::string_view Name(MoveVerdict verdict);  // "ok", "not_finite", ...

// Height over the longest edge (0.87 for a regular triangle), 0 without area.
double FaceHeight(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

// Mean length of the edges, 0 without faces.
double MeanEdge(const TriangleMesh& mesh);

// The mesh with the coordinates that an STL file holds. What is checked must be what is printed:
// rounding alone can make a fine mesh intersect itself.
TriangleMesh InSinglePrecision(const TriangleMesh& mesh);
Eigen::Vector3d InSinglePrecision(const Eigen::Vector3d& point);

// What keeps the mesh from being a printable solid (Inspect with the full self-intersection test),
// "" when it is one.
std::string WhyNotPrintable(const TriangleMesh& mesh);

}  // namespace antigrasp
