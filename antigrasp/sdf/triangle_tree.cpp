#include "antigrasp/sdf/triangle_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

constexpr std::int32_t kLeafSize = 4;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double SquaredDistanceToSegment(const Eigen::Vector3d& from_start, const Eigen::Vector3d& edge,
                                double inverse_squared_length) {
  const double t = std::clamp(from_start.dot(edge) * inverse_squared_length, 0.0, 1.0);
  return (from_start - t * edge).squaredNorm();
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  AG_CHECK(!mesh.faces.empty(), "distance to a mesh without faces");
  const auto vertices = static_cast<std::int32_t>(mesh.vertices.size());
  std::vector<Triangle> faces;
  faces.reserve(mesh.faces.size());
  for (const auto& face : mesh.faces) {
    for (const std::int32_t v : face) {
      AG_CHECK(v >= 0 && v < vertices && mesh.vertices[v].allFinite(), "broken face");
    }
    faces.push_back(
        Prepare(mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]));
  }
  std::vector<std::int32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0);
  triangles_.reserve(faces.size());
  nodes_.reserve(faces.size());
  nodes_.emplace_back();
  Split(0, 0, static_cast<std::int32_t>(faces.size()), &order, faces);
}

TriangleTree::Triangle TriangleTree::Prepare(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                             const Eigen::Vector3d& c) {
  Triangle t;
  t.corner = {a, b, c};
  t.edge = {b - a, c - b, a - c};
  double longest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double squared = t.edge[i].squaredNorm();
    longest = std::max(longest, squared);
    t.inverse_squared_length[i] = squared > 0.0 ? 1.0 / squared : 0.0;
  }
  const Eigen::Vector3d cross = t.edge[0].cross(c - a);
  // Below this height the normal is rounding noise, and the edges are the face to 1e-12 of its
  // size.
  t.degenerate = !(cross.norm() > 1e-12 * longest);
  t.normal = t.degenerate ? Eigen::Vector3d::Zero() : Eigen::Vector3d(cross.normalized());
  for (int i = 0; i < 3; ++i) t.inward[i] = t.normal.cross(t.edge[i]);
  return t;
}

double TriangleTree::SquaredDistance(const Triangle& t, const Eigen::Vector3d& point) {
  const std::array<Eigen::Vector3d, 3> from = {point - t.corner[0], point - t.corner[1],
                                               point - t.corner[2]};
  double best = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    // Seen from outside the face, the nearest point lies on an edge that faces the point.
    if (t.degenerate || from[i].dot(t.inward[i]) < 0.0) {
      best =
          std::min(best, SquaredDistanceToSegment(from[i], t.edge[i], t.inverse_squared_length[i]));
    }
  }
  if (best < kInfinity) return best;
  const double height = from[0].dot(t.normal);
  return height * height;
}

// Of the squared distance to anything in the node: the better of the box and the slab.
double TriangleTree::LowerBound(const Node& node, const Eigen::Vector3d& point) {
  const double along = node.axis.dot(point);
  const double slab = std::max({node.axis_min - along, along - node.axis_max, 0.0});
  const Eigen::Array3d below = (node.min - point).array(), above = (point - node.max).array();
  return std::max(slab * slab, below.max(above).max(0.0).matrix().squaredNorm());
}

TriangleTree::Node TriangleTree::Bound(const std::vector<std::int32_t>& order, std::int32_t first,
                                       std::int32_t count, const std::vector<Triangle>& faces) {
  Node node;
  node.first = first;
  node.count = count;
  node.min.setConstant(kInfinity);
  node.max = -node.min;
  node.axis_min = kInfinity;
  node.axis_max = -kInfinity;
  node.axis.setZero();
  for (std::int32_t i = first; i < first + count; ++i) node.axis += faces[order[i]].normal;
  node.axis.normalize();  // stays zero when it is zero: a slab that never prunes
  for (std::int32_t i = first; i < first + count; ++i) {
    for (const Eigen::Vector3d& corner : faces[order[i]].corner) {
      node.min = node.min.cwiseMin(corner);
      node.max = node.max.cwiseMax(corner);
      node.axis_min = std::min(node.axis_min, node.axis.dot(corner));
      node.axis_max = std::max(node.axis_max, node.axis.dot(corner));
    }
  }
  return node;
}

void TriangleTree::Split(std::int32_t node, std::int32_t first, std::int32_t count,
                         std::vector<std::int32_t>* order, const std::vector<Triangle>& faces) {
  nodes_[node] = Bound(*order, first, count, faces);
  if (count <= kLeafSize) {
    nodes_[node].first = static_cast<std::int32_t>(triangles_.size());
    for (std::int32_t i = first; i < first + count; ++i) triangles_.push_back(faces[(*order)[i]]);
    return;
  }
  int axis = 0;
  (nodes_[node].max - nodes_[node].min).maxCoeff(&axis);
  const auto key = [&](std::int32_t f) {
    const auto& c = faces[f].corner;
    return c[0][axis] + c[1][axis] + c[2][axis];
  };
  const std::int32_t half = count / 2;
  std::nth_element(
      order->begin() + first, order->begin() + first + half, order->begin() + first + count,
      [&](std::int32_t f, std::int32_t g) { return std::pair(key(f), f) < std::pair(key(g), g); });
  const auto left = static_cast<std::int32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_.emplace_back();
  nodes_[node].first = left;
  nodes_[node].count = 0;
  Split(left, first, half, order, faces);
  Split(left + 1, first + half, count - half, order, faces);
}

TriangleTree::Hit TriangleTree::Nearest(const Eigen::Vector3d& point, std::int32_t hint) const {
  Hit best{SquaredDistance(triangles_[hint], point), hint};
  struct Entry {
    double lower_bound;
    std::int32_t node;
  };
  std::array<Entry, 64> stack;  // halving 2^31 faces needs fewer
  std::size_t size = 0;
  stack[size++] = {LowerBound(nodes_[0], point), 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.lower_bound >= best.squared_distance) continue;
    const Node& node = nodes_[entry.node];
    if (node.count > 0) {
      for (std::int32_t t = node.first; t < node.first + node.count; ++t) {
        const Triangle& triangle = triangles_[t];
        const double height = triangle.normal.dot(point - triangle.corner[0]);
        if (height * height >= best.squared_distance) continue;
        const double squared = SquaredDistance(triangle, point);
        if (squared < best.squared_distance) best = {squared, t};
      }
      continue;
    }
    Entry near{LowerBound(nodes_[node.first], point), node.first};
    Entry far{LowerBound(nodes_[node.first + 1], point), node.first + 1};
    if (far.lower_bound < near.lower_bound) std::swap(near, far);
    if (far.lower_bound < best.squared_distance) stack[size++] = far;
    if (near.lower_bound < best.squared_distance) stack[size++] = near;
  }
  return best;
}

}  // namespace antigrasp
