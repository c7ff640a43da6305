#include "antigrasp/mesh/stable_poses.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "antigrasp/mesh/hull_facets.h"
#include "antigrasp/mesh/rolling.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A plate's normal nearer than this to the object's z axis (radians) is it but for rounding: the
// level direction across both says nothing.
constexpr double kUpright = 1e-4;

Eigen::Matrix3d TableFromObject(const Vector3d& up) {
  const Vector3d level(-up.y(), up.x(), 0.0);
  const Vector3d x =
      level.norm() > kUpright ? level.normalized() : (Vector3d::UnitX() - up.x() * up).normalized();
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), up.cross(x).transpose(), up.transpose();
  return rotation.array() + 0.0;  // no negative zeros
}

// CGAL triangulates a flat facet in an order that follows from addresses, and the last bits of sums
// over it with that. They are cut off here, so that equal meshes have equal poses.
constexpr double kKept = 0x1p44;  // of 2^53
double WithoutLastBits(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(kKept * mantissa) / kKept, exponent);
}
Vector3d WithoutLastBits(const Vector3d& unit) { return (kKept * unit).array().round() / kKept; }

// The poses of a symmetric object are equally likely but for rounding: these in an order that
// rounding cannot change.
bool LikelierFirst(const StablePose& a, const StablePose& b) {
  const auto key = [](const StablePose& pose) {
    const Vector3d up = (1e6 * pose.table_from_object.row(2).transpose()).array().round() + 0.0;
    return std::tuple(-std::round(1e9 * pose.probability), up.x(), up.y(), up.z());
  };
  return key(a) < key(b);
}

}  // namespace

std::vector<StablePose> StablePoses(const TriangleMesh& mesh, const Vector3d& com) {
  const FacetedHull hull = MakeFacetedHull(mesh, com);
  const bool inside = std::all_of(hull.facets.begin(), hull.facets.end(),
                                  [](const Facet& facet) { return facet.height > 0.0; });
  if (hull.facets.empty() || !inside) return {};
  const std::vector<std::size_t> resting = RestingFacets(hull);
  std::vector<StablePose> by_facet(hull.facets.size());
  for (std::size_t f = 0; f < resting.size(); ++f) {
    const Facet& facet = hull.facets[resting[f]];
    StablePose& pose = by_facet[resting[f]];
    pose.probability += hull.facets[f].solid_angle / (4.0 * std::numbers::pi);
    pose.table_from_object = TableFromObject(WithoutLastBits(Vector3d(-facet.normal)).normalized());
    pose.com_height = WithoutLastBits(facet.height);
  }
  for (StablePose& pose : by_facet) pose.probability = WithoutLastBits(pose.probability);
  std::erase_if(by_facet, [](const StablePose& pose) { return pose.probability <= 0.0; });
  std::stable_sort(by_facet.begin(), by_facet.end(), LikelierFirst);
  return by_facet;
}

}  // namespace antigrasp
