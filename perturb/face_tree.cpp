#include "antigrasp/perturb/face_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numeric>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

BoundingBox Union(const BoundingBox& a, const BoundingBox& b) {
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

// Distance along the ray to the face (Moeller and Trumbore 1997).
std::optional<double> HitFace(const TriangleMesh& mesh, std::int32_t face, const Vector3d& origin,
                              const Vector3d& direction) {
  const auto& corners = mesh.faces[face];
  const Vector3d& a = mesh.vertices[corners[0]];
  const Vector3d u = mesh.vertices[corners[1]] - a, v = mesh.vertices[corners[2]] - a;
  const Vector3d p = direction.cross(v);
  const double determinant = u.dot(p);
  if (determinant == 0.0) return std::nullopt;
  const Vector3d from = origin - a;
  const double s = from.dot(p) / determinant;
  if (!(s >= 0.0 && s <= 1.0)) return std::nullopt;
  const Vector3d q = from.cross(u);
  const double t = direction.dot(q) / determinant;
  if (!(t >= 0.0 && s + t <= 1.0)) return std::nullopt;
  const double distance = v.dot(q) / determinant;
  return distance > 0.0 ? std::optional(distance) : std::nullopt;
}

// Where the ray enters the box; infinity when it does not.
double EntersAt(const BoundingBox& box, const Vector3d& origin, const Vector3d& direction,
                const Vector3d& inverse) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double enter = 0.0, leave = kNever;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (origin[k] < box.min[k] || origin[k] > box.max[k]) return kNever;
      continue;
    }
    const double a = (box.min[k] - origin[k]) * inverse[k];
    const double b = (box.max[k] - origin[k]) * inverse[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave * (1.0 + 1e-14) ? enter : kNever;
}

}  // namespace

BoundingBox FaceBox(const TriangleMesh& mesh, std::int32_t face) {
  const auto& f = mesh.faces[face];
  const Vector3d &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

FaceTree::FaceTree(const TriangleMesh& mesh) : leaf_of_(mesh.faces.size()) {
  if (mesh.faces.empty()) return;
  std::vector<std::int32_t> order(mesh.faces.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * order.size());
  nodes_.emplace_back();
  Split(0, order.data(), static_cast<std::int32_t>(order.size()), mesh);
}

void FaceTree::Split(std::int32_t node, std::int32_t* first, std::int32_t count,
                     const TriangleMesh& mesh) {
  BoundingBox box = FaceBox(mesh, *first), centers{box.Center(), box.Center()};
  for (std::int32_t i = 1; i < count; ++i) {
    const BoundingBox of_face = FaceBox(mesh, first[i]);
    box = Union(box, of_face);
    centers = Union(centers, {of_face.Center(), of_face.Center()});
  }
  nodes_[node].box = box;
  if (count == 1) {
    nodes_[node].face = *first;
    leaf_of_[*first] = node;
    return;
  }
  int axis = 0;
  centers.Extent().maxCoeff(&axis);
  const auto key = [&](std::int32_t f) { return std::pair(FaceBox(mesh, f).Center()[axis], f); };
  const std::int32_t half = count / 2;
  std::nth_element(first, first + half, first + count,
                   [&](std::int32_t f, std::int32_t g) { return key(f) < key(g); });
  const auto left = static_cast<std::int32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].left = left;
  nodes_[left].parent = nodes_[left + 1].parent = node;
  Split(left, first, half, mesh);
  Split(left + 1, first + half, count - half, mesh);
}

void FaceTree::Refit(const TriangleMesh& mesh, std::int32_t face) {
  std::int32_t at = leaf_of_[face];
  nodes_[at].box = FaceBox(mesh, face);
  while ((at = nodes_[at].parent) >= 0) {
    Node& node = nodes_[at];
    const BoundingBox box = Union(nodes_[node.left].box, nodes_[node.left + 1].box);
    if (box.min == node.box.min && box.max == node.box.max) return;
    node.box = box;
  }
}

std::optional<FaceHit> FaceTree::FirstHit(const TriangleMesh& mesh, const Vector3d& origin,
                                          const Vector3d& direction, std::int32_t ignored) const {
  if (nodes_.empty()) return std::nullopt;
  struct Entry {
    double enter;
    std::int32_t node;
  };
  const Vector3d inverse = direction.cwiseInverse();
  const auto entry = [&](std::int32_t node) {
    return Entry{EntersAt(nodes_[node].box, origin, direction, inverse), node};
  };
  FaceHit hit{-1, std::numeric_limits<double>::infinity()};
  Entry stack[64];
  int size = 0;
  stack[size++] = entry(0);
  while (size > 0) {
    const Entry top = stack[--size];
    if (!(top.enter < hit.distance)) continue;
    const Node& node = nodes_[top.node];
    if (node.left < 0) {
      if (node.face == ignored) continue;
      const auto distance = HitFace(mesh, node.face, origin, direction);
      if (distance && *distance < hit.distance) hit = {node.face, *distance};
      continue;
    }
    Entry near = entry(node.left), far = entry(node.left + 1);
    if (far.enter < near.enter) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return hit.face >= 0 ? std::optional(hit) : std::nullopt;
}

}  // namespace antigrasp
