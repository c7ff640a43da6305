#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp::bench {

// The same evaluation the way one writes it from well-known parts: CGAL's AABB tree for the rays,
// one convex hull by Qhull (option Qt) for each epsilon. No gripper collision.
class CgalRays {
 public:
  explicit CgalRays(const TriangleMesh& mesh);
  ~CgalRays();

  struct Hit {
    Eigen::Vector3d point;
    Eigen::Vector3d normal;
  };
  // The first face met within `max_distance`.
  std::optional<Hit> Closest(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                             double max_distance) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

double EpsilonByQhull(const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com,
                      const WrenchModel& model);

// Mean epsilon over the draws for each of `grasps`, jaws closed by CgalRays.
std::vector<double> PeerQualities(const TriangleMesh& mesh_in_metres,
                                  const std::vector<ScoredGrasp>& grasps,
                                  const MetricOptions& options);

}  // namespace antigrasp::bench
