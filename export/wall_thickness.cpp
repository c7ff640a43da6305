#include "antigrasp/export/wall_thickness.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/export/rounding.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/surface_sampler.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Share of the object's size by which a ray starts below the surface, so that it does not meet its
// own face: far above the rounding of the tree's float, far below what is printed.
constexpr double kStart = 1e-5;

}  // namespace

WallThickness MeasureWalls(const TriangleMesh& mesh, const WallOptions& options) {
  WallThickness walls;
  const SurfaceSampler surface(mesh);
  if (!(surface.area() > 0.0)) return walls;
  const RayScene scene(mesh);
  const double size = Bounds(mesh).Extent().norm();
  const double limit = options.opposite_angle * std::numbers::pi / 180.0;
  std::vector<double> slack;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    slack.push_back(AngleSlack(mesh, f, options.rounding));
  }
  // Parallel sides are opposite at any limit, sides at the limit are not.
  const auto opposite = [&](std::size_t f, std::size_t g, double cosine) {
    const double both = slack[f] + slack[g];
    return cosine <= -std::cos(std::max(limit - both, both));
  };

  // The thickness below a point of a face with this outward normal.
  const auto measure = [&](const Vector3d& point, const Vector3d& normal,
                           std::size_t face) -> std::optional<double> {
    const auto hit = scene.Closest(point - kStart * size * normal, -normal, size);
    if (!hit || hit->front || !opposite(face, hit->face, hit->normal.dot(normal))) {
      return std::nullopt;
    }
    const double thickness = hit->distance + kStart * size;
    if (!walls.smallest || thickness < *walls.smallest) {
      walls.smallest = thickness;
      walls.at = point;
    }
    return thickness;
  };
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (IsDegenerate(mesh, f)) continue;
    const auto& face = mesh.faces[f];
    const Vector3d middle = (mesh.vertices[static_cast<std::size_t>(face[0])] +
                             mesh.vertices[static_cast<std::size_t>(face[1])] +
                             mesh.vertices[static_cast<std::size_t>(face[2])]) /
                            3.0;
    measure(middle, FaceCross(mesh, f).normalized(), f);
  }
  RngStream rng(0, "wall thickness");
  int thin = 0;
  for (int i = 0; i < options.samples; ++i) {
    const SurfaceSampler::Sample sample = surface.Draw(&rng);
    const auto thickness = measure(sample.point, sample.normal, sample.face);
    thin += thickness && *thickness < options.thin ? 1 : 0;
  }
  if (options.samples > 0) walls.thin_share = static_cast<double>(thin) / options.samples;
  return walls;
}

}  // namespace antigrasp
