#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A bounding-volume hierarchy over the faces of a mesh for exact nearest-face queries.
class TriangleTree {
 public:
  struct Hit {
    double squared_distance;
    std::int32_t triangle;  // the tree's own numbering: only good as a hint for another query
  };

  // CHECKs that the mesh has faces, that indices are in range and vertices finite.
  explicit TriangleTree(const TriangleMesh& mesh);

  Hit Nearest(const Eigen::Vector3d& point) const;

  // The same for points that differ in x only, searched together: several times faster a point.
  // `hint`, a face near the first point, is looked at first.
  static constexpr int kRowPoints = 8;
  struct Row {
    alignas(16) std::array<double, kRowPoints> x;
    double y, z;
  };
  std::array<Hit, kRowPoints> Nearest(const Row& row, std::int32_t hint = 0) const;

 private:
  // A face with all that the distance needs. Degenerate faces are their edges.
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corner;
    std::array<Eigen::Vector3d, 3> edge;    // corner i to i + 1
    std::array<Eigen::Vector3d, 3> inward;  // in the plane, square to edge i
    std::array<double, 3> inverse_squared_length;
    Eigen::Vector3d normal;  // unit
    bool degenerate;
  };
  struct Node {
    Eigen::Vector3d min, max;
    Eigen::Vector3d axis;  // mean normal: curved surfaces are thin along it where boxes are not
    double axis_min, axis_max;
    std::int32_t first;  // leaf: its first triangle; else the left child, the right one follows it
    std::int32_t count;  // of triangles; 0 for an inner node
  };

  static Triangle Prepare(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                          const Eigen::Vector3d& c);
  // One value for each point of the row, in pairs that every x86-64 (and ARM64) has registers for.
  using Pair = double __attribute__((vector_size(16)));
  using RowValues = std::array<Pair, kRowPoints / 2>;
  static RowValues SquaredDistances(const Triangle& triangle, const Row& row);
  static RowValues LowerBounds(const Node& node, const Row& row);  // of squared distances
  static Node Bound(const std::vector<std::int32_t>& order, std::int32_t first, std::int32_t count,
                    const std::vector<Triangle>& faces);
  void Split(std::int32_t node, std::int32_t first, std::int32_t count,
             std::vector<std::int32_t>* order, const std::vector<Triangle>& faces);

  std::vector<Triangle> triangles_;  // leaf by leaf
  std::vector<Node> nodes_;
};

}  // namespace antigrasp
