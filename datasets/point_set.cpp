#include "antigrasp/datasets/point_set.h"

#include <algorithm>
#include <limits>

#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/surface_sampler.h"

namespace antigrasp {
namespace {

constexpr float kFarOff = std::numeric_limits<float>::infinity();

// Takes `point_of(sample)` of every sample.
template <int D, typename PointOf>
PointBlocks<D> Drawn(const TriangleMesh& mesh, int count, std::uint64_t seed, std::uint64_t set,
                     std::uint64_t shape, const PointOf& point_of) {
  AG_CHECK(count > 0, "at least one point a shape");
  const SurfaceSampler surface(mesh);
  RngStream rng(seed, "surface points", set, shape);
  std::vector<Eigen::Matrix<float, D, 1>> points;
  for (int i = 0; i < count; ++i) points.push_back(point_of(surface.Draw(&rng)));
  return PointBlocks<D>(std::move(points));
}

}  // namespace

template <int D>
PointBlocks<D>::PointBlocks(std::vector<Point> points) : size_(points.size()) {
  AG_CHECK(!points.empty(), "a point set has at least one point");
  for (const Point& point : points) AG_CHECK(point.allFinite(), "finite points");
  Split(points.data(), points.size());
  AddGroups();
  for (std::size_t k = 0; k < kSize; ++k) {
    for (Boxes* boxes : {&boxes_, &groups_}) {
      const std::size_t padded = (boxes->low[k].size() + kBlock - 1) / kBlock * kBlock;
      boxes->low[k].resize(padded, kFarOff);
      boxes->high[k].resize(padded, kFarOff);
    }
  }
}

template <int D>
void PointBlocks<D>::AddGroups() {
  for (std::size_t k = 0; k < kSize; ++k) {
    for (std::size_t first = 0; first < blocks_.size(); first += kGroup) {
      const auto from = static_cast<std::ptrdiff_t>(first);
      const auto to = static_cast<std::ptrdiff_t>(std::min(first + kGroup, blocks_.size()));
      groups_.low[k].push_back(
          *std::min_element(boxes_.low[k].begin() + from, boxes_.low[k].begin() + to));
      groups_.high[k].push_back(
          *std::max_element(boxes_.high[k].begin() + from, boxes_.high[k].begin() + to));
    }
  }
}

// Halves the blocks across the longest side until one is left; all but the last one are full.
template <int D>
void PointBlocks<D>::Split(Point* points, std::size_t count) {
  if (count <= kBlock) {
    AddBlock(points, count);
    return;
  }
  Point low = points[0], high = points[0];
  for (std::size_t i = 1; i < count; ++i) {
    low = low.cwiseMin(points[i]);
    high = high.cwiseMax(points[i]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::size_t half = (count + kBlock - 1) / kBlock / 2 * kBlock;
  std::nth_element(points, points + half, points + count,
                   [axis](const Point& a, const Point& b) { return a[axis] < b[axis]; });
  Split(points, half);
  Split(points + half, count - half);
}

template <int D>
void PointBlocks<D>::AddBlock(const Point* points, std::size_t count) {
  Block block;
  block.used = count;
  Point low = points[0], high = points[0];
  for (std::size_t lane = 0; lane < kBlock; ++lane) {
    const Point& point = points[std::min(lane, count - 1)];
    for (std::size_t k = 0; k < kSize; ++k) {
      block.at[k][lane] = point[static_cast<Eigen::Index>(k)];
    }
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  blocks_.push_back(block);
  for (std::size_t k = 0; k < kSize; ++k) {
    boxes_.low[k].push_back(low[static_cast<Eigen::Index>(k)]);
    boxes_.high[k].push_back(high[static_cast<Eigen::Index>(k)]);
  }
}

template class PointBlocks<3>;
template class PointBlocks<6>;

PointSet SurfacePoints(const TriangleMesh& mesh, int count, std::uint64_t seed, std::uint64_t set,
                       std::uint64_t shape, const Eigen::Vector3d& origin) {
  return Drawn<3>(mesh, count, seed, set, shape,
                  [&](const SurfaceSampler::Sample& sample) -> PointSet::Point {
                    return (sample.point - origin).cast<float>();
                  });
}

OrientedPointSet OrientedSurfacePoints(const TriangleMesh& mesh, int count, std::uint64_t seed,
                                       std::uint64_t set, std::uint64_t shape, double length,
                                       const Eigen::Vector3d& origin) {
  return Drawn<6>(mesh, count, seed, set, shape, [&](const SurfaceSampler::Sample& sample) {
    OrientedPointSet::Point point;
    point << (sample.point - origin).cast<float>(), (length * sample.normal).cast<float>();
    return point;
  });
}

}  // namespace antigrasp
