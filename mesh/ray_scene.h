#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

struct RayHit {
  double distance = 0.0;
  std::size_t face = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // unit, by the winding: outward
  bool front = true;                                  // met from the side the normal points to
};

// A static mesh prepared for closest-hit queries (Embree 3). The tree works in float about the
// mesh's centre and picks the face; distance and point are then computed in double from that face's
// plane. Faces without area are left out. Queries are const and thread-safe; one build is 0.5 ms
// for 2,500 faces, one query about 0.1 us.
class RayScene {
 public:
  explicit RayScene(const TriangleMesh& mesh);  // vertices finite, indices in range
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // The first face met from `origin` along the unit `direction` within `max_distance`.
  std::optional<RayHit> Closest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double max_distance) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace antigrasp
