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

double TriangleTree::SquaredDistance(const Node& node, const Eigen::Vector3d& point) {
  const Eigen::Array3d below = (node.min - point).array(), above = (point - node.max).array();
  return below.max(above).max(0.0).matrix().squaredNorm();
}

void TriangleTree::Split(std::int32_t node, std::int32_t first, std::int32_t count,
                         std::vector<std::int32_t>* order, const std::vector<Triangle>& faces) {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(kInfinity), max = -min;
  for (std::int32_t i = first; i < first + count; ++i) {
    for (const Eigen::Vector3d& corner : faces[(*order)[i]].corner) {
      min = min.cwiseMin(corner);
      max = max.cwiseMax(corner);
    }
  }
  if (count <= kLeafSize) {
    nodes_[node] = {min, max, static_cast<std::int32_t>(triangles_.size()), count};
    for (std::int32_t i = first; i < first + count; ++i) triangles_.push_back(faces[(*order)[i]]);
    return;
  }
  int axis = 0;
  (max - min).maxCoeff(&axis);
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
  nodes_[node] = {min, max, left, 0};
  Split(left, first, half, order, faces);
  Split(left + 1, first + half, count - half, order, faces);
}

TriangleTree::Hit TriangleTree::Nearest(const Eigen::Vector3d& point, std::int32_t hint) const {
  Hit best{SquaredDistance(triangles_[hint], point), hint};
  struct Entry {
    double squared_distance;
    std::int32_t node;
  };
  std::array<Entry, 64> stack;  // halving 2^31 faces needs fewer
  std::size_t size = 0;
  stack[size++] = {SquaredDistance(nodes_[0], point), 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared_distance >= best.squared_distance) continue;
    const Node& node = nodes_[entry.node];
    if (node.count > 0) {
      for (std::int32_t t = node.first; t < node.first + node.count; ++t) {
        const double squared = SquaredDistance(triangles_[t], point);
        if (squared < best.squared_distance) best = {squared, t};
      }
      continue;
    }
    Entry near{SquaredDistance(nodes_[node.first], point), node.first};
    Entry far{SquaredDistance(nodes_[node.first + 1], point), node.first + 1};
    if (far.squared_distance < near.squared_distance) std::swap(near, far);
    if (far.squared_distance < best.squared_distance) stack[size++] = far;
    if (near.squared_distance < best.squared_distance) stack[size++] = near;
  }
  return best;
}

}  // namespace antigrasp
