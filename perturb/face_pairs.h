#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Antipodal face pairs, the set F_a of section IV: pairs (i, j) of faces that hold points p and q
// with q - p inside both friction cones, the one about -n_i and the one about n_j. Nothing is asked
// of what lies between p and q.

// phi(f_i, f_j) = arccos(-n_i . n_j): 0 for opposite faces that are parallel. Unit normals;
// radians.
double AntipodalityAngle(const Eigen::Vector3d& normal_i, const Eigen::Vector3d& normal_j);

// A face as the test wants it.
struct FaceShape {
  FaceShape() = default;
  FaceShape(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  FaceShape(const TriangleMesh& mesh, std::size_t face);
  bool has_area() const { return normal != Eigen::Vector3d::Zero(); }

  std::array<Eigen::Vector3d, 3> corner;
  Eigen::Vector3d normal;  // outward unit normal; zero for a face without area
  Eigen::Vector3d center;  // of a ball around the face
  double radius = 0.0;
};

struct PairLimits {
  double cone_angle = 0.4636476090008061;  // psi = atan(mu), radians in [0, pi / 2); mu = 0.5
  double max_width = std::numeric_limits<double>::infinity();  // jaw opening, mesh units
  double width_slack = 0.0;  // a pair may be wider than max_width by this share of it
};

// Decides one pair, exactly up to kConeSlack. The differences q - p fill a polytope D (the
// Minkowski difference of the two triangles), the allowed directions a lens K (two round cones);
// both are convex. Seen from the origin, D and K meet only if
//   - the axes are at most 2 psi apart (else K is empty), and
//   - the lens's middle direction is a direction of D (K may lie inside of D's outline), or
//   - one of D's edges meets K. Every edge of D is an edge of one triangle against a corner of the
//     other: 18 segments, each clipped by both cones in closed form.
// With max_width the nearest point of D in K is found as well: it lies on one of those segments or,
// on a facet of D, in the direction of K nearest to the facet's normal (3 edges x 3 edges and the
// two faces' own normals). Faces that share corners hold p = q there; this is no grasp and does
// not count. Cost: 4-9 ns when normals, enclosing balls or the two centroids decide (97 % of the
// pairs of a remeshed object), 0.2 us else; with max_width 3 us where that is near.
class AntipodalTest {
 public:
  explicit AntipodalTest(const PairLimits& limits);
  bool operator()(const FaceShape& first, const FaceShape& second) const;

  // The smallest |q - p|; infinity when the pair is not antipodal at any width.
  double Width(const FaceShape& first, const FaceShape& second) const;

  double cone_angle() const { return limits_.cone_angle; }
  double max_width() const { return limits_.max_width; }  // with the slack

 private:
  enum class Guess { kNo, kYes, kOpen };
  Guess ByCenters(const FaceShape& first, const FaceShape& second) const;
  bool Meet(const FaceShape& first, const FaceShape& second) const;

  PairLimits limits_;
  double cosine_, sine_, cosine_of_double_;
};

struct FacePair {
  std::int32_t first, second;  // first < second
  friend bool operator==(const FacePair&, const FacePair&) = default;
  friend auto operator<=>(const FacePair&, const FacePair&) = default;
};

// All of F_a, in order. The faces stand in a tree whose nodes have an enclosing ball and a cone of
// normals; two nodes are compared at a time, and dropped or taken whole when every pair of theirs
// is decided alike. The number of pairs grows with the square of the number of faces (an eighth of
// all pairs on bottle-like objects at mu = 0.5).
std::vector<FacePair> AntipodalPairs(const TriangleMesh& mesh, const PairLimits& limits);

// |F_a| without listing it: whole blocks are only counted. What is left undecided grows with
// n^1.5 and is nearly all of the time (5 s for 100,000 faces, minutes for a million). Of a mesh
// with more than `most_counted` faces it is therefore estimated, by two pairs of any two leaves of
// n / 8,192 faces: O(n log n), 3 s for a million. Within 0.02 % on round meshes of 100,000; the
// same for the same mesh.
inline constexpr std::size_t kMostCounted = 65536;
std::int64_t CountAntipodalPairs(const TriangleMesh& mesh, const PairLimits& limits,
                                 std::size_t most_counted = kMostCounted);

}  // namespace antigrasp
