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

  // The nearest face. `hint` is searched first: the answer to a query close by makes it faster and
  // changes the distance by rounding at most.
  Hit Nearest(const Eigen::Vector3d& point, std::int32_t hint = 0) const;

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
  static double SquaredDistance(const Triangle& triangle, const Eigen::Vector3d& point);
  static double LowerBound(const Node& node, const Eigen::Vector3d& point);
  static Node Bound(const std::vector<std::int32_t>& order, std::int32_t first, std::int32_t count,
                    const std::vector<Triangle>& faces);
  void Split(std::int32_t node, std::int32_t first, std::int32_t count,
             std::vector<std::int32_t>* order, const std::vector<Triangle>& faces);

  std::vector<Triangle> triangles_;  // leaf by leaf
  std::vector<Node> nodes_;
};

}  // namespace antigrasp
