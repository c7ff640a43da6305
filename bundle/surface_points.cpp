#include "antigrasp/bundle/surface_points.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace antigrasp {

using Eigen::Vector3d;

TriangleMesh Refined(const TriangleMesh& mesh, double length) {
  TriangleMesh fine;
  fine.vertices = mesh.vertices;
  std::vector<std::array<std::int32_t, 3>> open(mesh.faces.rbegin(), mesh.faces.rend());
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    const auto at = [&](std::size_t k) {
      return fine.vertices[static_cast<std::size_t>(face[k % 3])];
    };
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if ((at(k + 1) - at(k)).norm() > (at(longest + 1) - at(longest)).norm()) longest = k;
    }
    if ((at(longest + 1) - at(longest)).norm() <= length) {
      fine.faces.push_back(face);
      continue;
    }
    const auto middle = static_cast<std::int32_t>(fine.vertices.size());
    fine.vertices.push_back(0.5 * (at(longest + 1) + at(longest)));
    const std::int32_t a = face[longest], b = face[(longest + 1) % 3], c = face[(longest + 2) % 3];
    open.push_back({middle, b, c});
    open.push_back({a, middle, c});
  }
  return fine;
}

SurfacePoints PointsOf(const TriangleMesh& mesh) {
  SurfacePoints surface;
  surface.points = mesh.vertices;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    Vector3d middle = Vector3d::Zero();
    for (const std::int32_t corner : mesh.faces[f]) {
      middle += mesh.vertices[static_cast<std::size_t>(corner)] / 3.0;
    }
    surface.middles.push_back(middle);
    surface.crosses.push_back(FaceCross(mesh, f));
  }
  surface.normals.assign(mesh.vertices.size(), Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::int32_t corner : mesh.faces[f]) {
      surface.normals[static_cast<std::size_t>(corner)] += surface.crosses[f];
    }
  }
  surface.normals.insert(surface.normals.end(), surface.crosses.begin(), surface.crosses.end());
  for (Vector3d& normal : surface.normals) normal.normalize();
  surface.points.insert(surface.points.end(), surface.middles.begin(), surface.middles.end());
  return surface;
}

DeepPoint DeepestIn(const ConvexPart& hull, const SurfacePoints& surface, double enough) {
  DeepPoint deepest{enough, {}};
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const double depth = hull.Way(surface.points[i], surface.normals[i], deepest.depth);
    if (depth > deepest.depth) deepest = {depth, surface.points[i]};
  }
  return deepest;
}

std::vector<Vector3d> DeepPlaces(const ConvexPart& hull, const SurfacePoints& surface,
                                 const DeepPoint& deepest, double share, std::size_t count) {
  std::vector<Vector3d> deep;
  const double least = share * deepest.depth;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    if (hull.Way(surface.points[i], surface.normals[i], least) > least) {
      deep.push_back(surface.points[i]);
    }
  }
  std::vector<Vector3d> places{deepest.point};
  std::vector<double> distance(deep.size(), std::numeric_limits<double>::max());
  while (places.size() < count && !deep.empty()) {
    for (std::size_t i = 0; i < deep.size(); ++i) {
      distance[i] = std::min(distance[i], (deep[i] - places.back()).squaredNorm());
    }
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (!(*farthest > 0.0)) break;
    places.push_back(deep[static_cast<std::size_t>(farthest - distance.begin())]);
  }
  return places;
}

}  // namespace antigrasp
