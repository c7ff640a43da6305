#pragma once

#include <optional>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/surface_sampler.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/contact.h"

namespace antigrasp {

// A direction uniform over the solid angle of the cone of this half angle about the unit `axis`;
// two uniform numbers.
Eigen::Vector3d DrawInCone(const Eigen::Vector3d& axis, double half_angle, RngStream* rng);

// Why a candidate is no antipodal grasp.
enum class GraspRejection {
  kNoOpposite,  // nothing to close on within the opening, or only its inside
  kSlips,       // the opposite contact is outside its friction cone
  kJawBlocked   // a jaw misses, starts inside the object or meets another face first
};

// Draws antipodal grasps (paper III-B, Dex-Net 1.0): a point uniform over the surface, a direction
// uniform over the friction cone about its inward normal, the opposite contact where a jaw coming
// back along that line from the full opening first touches.
class AntipodalSampler {
 public:
  // Both must outlive the sampler. Metres.
  AntipodalSampler(const TriangleMesh& mesh, const RayScene& scene, double friction,
                   double jaw_opening);

  double area() const { return surface_.area(); }

  // One candidate; nullopt unless both jaws, opened symmetrically about the contacts' midpoint,
  // reach the two contacts first and neither slips; then `why`, unless null, says what was wrong.
  // Always uses five uniform numbers.
  std::optional<Grasp> Try(RngStream* rng, GraspRejection* why = nullptr) const;

 private:
  SurfaceSampler surface_;
  const RayScene& scene_;
  double friction_;
  double jaw_opening_;
};

}  // namespace antigrasp
