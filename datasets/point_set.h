#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A shape as points of its surface, cut into blocks of neighbours so that a search for nearest
// points can leave most of them out. float32, in the unit of the points. D: 3, or 6 with normals.
template <int D>
class PointBlocks {
 public:
  static constexpr std::size_t kBlock = 16;
  static constexpr auto kSize = static_cast<std::size_t>(D);
  using Point = Eigen::Matrix<float, D, 1>;

  struct Block {
    // One array a coordinate. Lanes beyond `used` repeat a point of the block: harmless to look at,
    // not to be counted.
    alignas(64) std::array<std::array<float, kBlock>, kSize> at;
    std::size_t used = 0;
  };
  // The blocks' bounding boxes, one array a coordinate; filled up to a multiple of kBlock with
  // boxes at infinity.
  struct Boxes {
    std::array<std::vector<float>, kSize> low, high;
  };

  static constexpr std::size_t kGroup = kBlock;  // blocks that Split left beside each other

  // At least one point, all finite as float32. The order of the points does not matter beyond
  // rounding. O(n log n).
  explicit PointBlocks(std::vector<Point> points);

  std::size_t size() const { return size_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const Boxes& boxes() const { return boxes_; }
  const Boxes& groups() const { return groups_; }  // around kGroup boxes each, filled up likewise

 private:
  void Split(Point* points, std::size_t count);
  void AddBlock(const Point* points, std::size_t count);
  void AddGroups();

  std::size_t size_;
  std::vector<Block> blocks_;
  Boxes boxes_, groups_;
};

using PointSet = PointBlocks<3>;
// (point, length * unit normal). Points of surfaces that are a step s apart and turned by an angle
// t are sqrt(s^2 + (2 length sin(t / 2))^2) apart: a bend of radius `length` counts as much as the
// way along it.
using OrientedPointSet = PointBlocks<6>;

// `count` points uniform over the area of the mesh (its area > 0), from the stream
// RngStream(seed, "surface points", set, shape): two samplings of one mesh differ unless all three
// are equal. Points are float, relative to `origin`: one for all that are compared, near to them.
PointSet SurfacePoints(const TriangleMesh& mesh, int count, std::uint64_t seed, std::uint64_t set,
                       std::uint64_t shape,
                       const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

// The same points with `length` times the outward normals of their faces.
OrientedPointSet OrientedSurfacePoints(const TriangleMesh& mesh, int count, std::uint64_t seed,
                                       std::uint64_t set, std::uint64_t shape, double length,
                                       const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace antigrasp
