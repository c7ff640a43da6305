#include "antigrasp/mesh/surface_sampler.h"

#include <algorithm>

#include "antigrasp/core/check.h"

namespace antigrasp {

using Eigen::Vector3d;

SurfaceSampler::SurfaceSampler(const TriangleMesh& mesh) : mesh_(mesh) {
  cumulative_.reserve(mesh.faces.size());
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    area += 0.5 * FaceCross(mesh, i).norm();
    cumulative_.push_back(area);
  }
}

SurfaceSampler::Sample SurfaceSampler::Draw(RngStream* rng) const {
  AG_CHECK(area() > 0.0, "sampling needs a surface with area");
  // upper_bound never lands on a face without area: its sum equals its predecessor's.
  const double at = area() * rng->Uniform();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
  const auto face =
      static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
  double a = rng->Uniform();
  double b = rng->Uniform();
  if (a + b > 1.0) {  // fold the parallelogram onto the triangle
    a = 1.0 - a;
    b = 1.0 - b;
  }
  const auto& corners = mesh_.faces[face];
  const Vector3d& p0 = mesh_.vertices[static_cast<std::size_t>(corners[0])];
  const Vector3d& p1 = mesh_.vertices[static_cast<std::size_t>(corners[1])];
  const Vector3d& p2 = mesh_.vertices[static_cast<std::size_t>(corners[2])];
  return {p0 + a * (p1 - p0) + b * (p2 - p0), FaceCross(mesh_, face).normalized(), face};
}

}  // namespace antigrasp
