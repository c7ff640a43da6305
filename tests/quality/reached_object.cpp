#include "tests/quality/reached_object.h"

#include "antigrasp/core/rng.h"
#include "antigrasp/quality/antipodal_sampler.h"

namespace antigrasp {

TriangleMesh Moved(const TriangleMesh& mesh, double x, double y, double z) {
  return Transformed(mesh, 1.0, {x, y, z});
}

std::vector<Grasp> SampledGrasps(const ReachedObject& object, int attempts) {
  const AntipodalSampler sampler(object.mesh, object.scene, 0.5, kGripperOpening);
  std::vector<Grasp> grasps;
  for (int i = 0; i < attempts; ++i) {
    RngStream rng(1, "grasp", 0, static_cast<std::uint64_t>(i));
    if (const auto grasp = sampler.Try(&rng)) grasps.push_back(*grasp);
  }
  return grasps;
}

}  // namespace antigrasp
