#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

struct FaceHit {
  std::int32_t face = 0;
  double distance = 0.0;
};

// A bounding-volume hierarchy over the faces of a mesh whose vertices move: after a move the boxes
// around the changed faces are made anew up to the root (about 0.2 us a face), the tree keeps its
// shape. Queries take the same mesh and are exact however far it has moved; they get slower when it
// moves far. Boxes are closed: what touches overlaps.
class FaceTree {
 public:
  explicit FaceTree(const TriangleMesh& mesh);  // indices in range, vertices finite

  void Refit(const TriangleMesh& mesh, std::int32_t face);

  // Calls visit(face) for every face whose box meets `box`, until it returns true.
  template <typename Visit>
  bool AnyOverlap(const BoundingBox& box, const Visit& visit) const;

  // The first face, other than `ignored`, met from `origin` along the unit `direction`.
  std::optional<FaceHit> FirstHit(const TriangleMesh& mesh, const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction, std::int32_t ignored) const;

  const BoundingBox& BoxOf(std::int32_t face) const { return nodes_[leaf_of_[face]].box; }

 private:
  struct Node {
    BoundingBox box;
    std::int32_t parent = -1;
    std::int32_t left = -1;  // the right child follows it; -1 for a leaf
    std::int32_t face = -1;  // of a leaf
  };
  void Split(std::int32_t node, std::int32_t* first, std::int32_t count, const TriangleMesh& mesh);

  std::vector<Node> nodes_;  // children behind their parent
  std::vector<std::int32_t> leaf_of_;
};

BoundingBox FaceBox(const TriangleMesh& mesh, std::int32_t face);

inline bool BoxesMeet(const BoundingBox& a, const BoundingBox& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

template <typename Visit>
bool FaceTree::AnyOverlap(const BoundingBox& box, const Visit& visit) const {
  std::int32_t stack[64];  // halving 2^31 faces needs fewer
  int size = 0;
  if (!nodes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!BoxesMeet(node.box, box)) continue;
    if (node.left < 0) {
      if (visit(node.face)) return true;
    } else {
      stack[size++] = node.left;
      stack[size++] = node.left + 1;
    }
  }
  return false;
}

}  // namespace antigrasp
