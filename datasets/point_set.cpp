#include "antigrasp/datasets/point_set.h"

#include <algorithm>
#include <limits>

#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/surface_sampler.h"

namespace antigrasp {

using Eigen::Vector3f;

PointSet::PointSet(std::vector<Vector3f> points) : size_(points.size()) {
  AG_CHECK(!points.empty(), "a point set has at least one point");
  for (const Vector3f& point : points) AG_CHECK(point.allFinite(), "finite points");
  Split(points.data(), points.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t padded = (blocks_.size() + kBlock - 1) / kBlock * kBlock;
    boxes_.low[k].resize(padded, std::numeric_limits<float>::infinity());
    boxes_.high[k].resize(padded, std::numeric_limits<float>::infinity());
  }
}

// Halves the blocks across the longest side until one is left; all but the last one are full.
void PointSet::Split(Vector3f* points, std::size_t count) {
  if (count <= kBlock) {
    AddBlock(points, count);
    return;
  }
  Vector3f low = points[0], high = points[0];
  for (std::size_t i = 1; i < count; ++i) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = (count + kBlock - 1) / kBlock / 2 * kBlock;
  std::nth_element(points, points + half, points + count,
                   [axis](const Vector3f& a, const Vector3f& b) { return a[axis] < b[axis]; });
  Split(points, half);
  Split(points + half, count - half);
}

void PointSet::AddBlock(const Vector3f* points, std::size_t count) {
  Block block;
  block.used = count;
  Vector3f low = points[0], high = points[0];
  for (std::size_t lane = 0; lane < kBlock; ++lane) {
    const Vector3f& point = points[std::min(lane, count - 1)];
    block.x[lane] = point.x();
    block.y[lane] = point.y();
    block.z[lane] = point.z();
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  blocks_.push_back(block);
  for (std::size_t k = 0; k < 3; ++k) {
    boxes_.low[k].push_back(low[static_cast<Eigen::Index>(k)]);
    boxes_.high[k].push_back(high[static_cast<Eigen::Index>(k)]);
  }
}

PointSet SurfacePoints(const TriangleMesh& mesh, int count, std::uint64_t seed, std::uint64_t set,
                       std::uint64_t shape, const Eigen::Vector3d& origin) {
  AG_CHECK(count > 0, "at least one point a shape");
  const SurfaceSampler surface(mesh);
  RngStream rng(seed, "surface points", set, shape);
  std::vector<Vector3f> points;
  for (int i = 0; i < count; ++i) {
    points.push_back((surface.Draw(&rng).point - origin).cast<float>());
  }
  return PointSet(std::move(points));
}

}  // namespace antigrasp
