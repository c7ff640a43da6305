#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A shape as points of its surface, cut into blocks of neighbours so that a search for nearest
// points can leave most of them out. float32, in the unit of the points.
class PointSet {
 public:
  static constexpr std::size_t kBlock = 16;

  struct Block {
    // Lanes beyond `used` repeat a point of the block: harmless to look at, not to be counted.
    alignas(64) std::array<float, kBlock> x, y, z;
    std::size_t used = 0;
  };
  // The blocks' bounding boxes, one array a coordinate; filled up to a multiple of kBlock with
  // boxes at infinity.
  struct Boxes {
    std::array<std::vector<float>, 3> low, high;
  };

  // At least one point, all finite as float32. The order of the points does not matter beyond
  // rounding. O(n log n).
  explicit PointSet(std::vector<Eigen::Vector3f> points);

  std::size_t size() const { return size_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const Boxes& boxes() const { return boxes_; }

 private:
  void Split(Eigen::Vector3f* points, std::size_t count);
  void AddBlock(const Eigen::Vector3f* points, std::size_t count);

  std::size_t size_;
  std::vector<Block> blocks_;
  Boxes boxes_;
};

// `count` points uniform over the area of the mesh (its area > 0), from the stream
// RngStream(seed, "surface points", set, shape): two samplings of one mesh differ unless all three
// are equal. Points are float, relative to `origin`: one for all that are compared, near to them.
PointSet SurfacePoints(const TriangleMesh& mesh, int count, std::uint64_t seed, std::uint64_t set,
                       std::uint64_t shape,
                       const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace antigrasp
