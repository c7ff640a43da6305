#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {

// A right circular cylinder (axis = third column of `axes`) or a box, in any pose.
struct Primitive {
  enum class Shape { kCylinder, kBox };
  Shape shape = Shape::kBox;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // columns: own axes, orthonormal
  Eigen::Vector3d half = Eigen::Vector3d::Ones();      // half sizes; cylinder: radius, radius, half
};

// Exact signed distance, positive inside.
double SignedDistance(const Primitive& primitive, const Eigen::Vector3d& point);
// The surface point nearest to a point inside.
Eigen::Vector3d NearestFromInside(const Primitive& primitive, const Eigen::Vector3d& point);
BoundingBox Bounds(const Primitive& primitive);

// The union of convex primitives and its signed distance, positive inside. Outside the largest
// distance of a part is exact. Inside it is only a lower bound where the part's nearest surface
// point is buried in another part: there the distance is measured to the bare surface, each part's
// facets clipped by the others (exact for boxes; cylinders have kSegments sides: 1.2e-3 radius).
class GraftedSolid {
 public:
  static constexpr int kSegments = 64;
  explicit GraftedSolid(std::vector<Primitive> parts);

  double SignedDistance(const Eigen::Vector3d& point) const;
  BoundingBox Bounds() const;

 private:
  std::vector<Primitive> parts_;
  std::optional<MeshDistance> bare_surface_;
};

}  // namespace antigrasp
