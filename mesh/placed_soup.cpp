#include "antigrasp/mesh/placed_soup.h"

#include <algorithm>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr std::size_t kMostFaces = 10'000'000;
constexpr std::size_t kMostVertices = 3 * kMostFaces;

void RequireOwnCorners(const PolygonSoup& part, const std::string& name, const std::string& path) {
  const auto vertices = static_cast<std::int64_t>(part.vertices.size());
  for (const std::int64_t corner : part.corners) {
    if (corner >= 0 && corner < vertices) continue;
    throw InputError(
        name + ": a face refers to vertex number " + std::to_string(corner) + " (counted from 0)",
        path, "one of its " + std::to_string(vertices) + " vertices");
  }
}

}  // namespace

void AppendPlaced(const PolygonSoup& part, const Eigen::Affine3d& place, const std::string& name,
                  const std::string& path, PolygonSoup* soup) {
  if (part.ends.size() > kMostFaces - soup->ends.size() ||
      part.vertices.size() > kMostVertices - soup->vertices.size()) {
    throw InputError("more than 10000000 faces", path, "fewer, copies counted");
  }
  RequireOwnCorners(part, name, path);
  const auto first = static_cast<std::int64_t>(soup->vertices.size());
  for (const Eigen::Vector3d& vertex : part.vertices) soup->vertices.push_back(place * vertex);
  const bool mirrored = place.linear().determinant() < 0.0;
  std::size_t begin = 0;
  for (const std::size_t end : part.ends) {
    const std::size_t at = soup->corners.size();
    for (std::size_t i = begin; i < end; ++i) soup->corners.push_back(first + part.corners[i]);
    if (mirrored) {
      std::reverse(soup->corners.begin() + static_cast<std::ptrdiff_t>(at), soup->corners.end());
    }
    soup->EndPolygon();
    begin = end;
  }
}

}  // namespace antigrasp
