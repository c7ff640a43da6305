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

using Pair = double __attribute__((vector_size(16)));

Pair Min(const Pair& a, const Pair& b) { return a < b ? a : b; }
Pair Max(const Pair& a, const Pair& b) { return a > b ? a : b; }
Pair Both(double v) { return Pair{v, v}; }

Pair PairOf(const TriangleTree::Row& row, std::size_t i) {
  return Pair{row.x[2 * i], row.x[2 * i + 1]};
}

template <typename RowValues>
double Largest(const RowValues& values) {
  Pair largest = values[0];
  for (const Pair& pair : values) largest = Max(largest, pair);
  return std::max(largest[0], largest[1]);
}

template <typename RowValues>
bool AnyLess(const RowValues& a, const RowValues& b) {
  auto less = a[0] < b[0];
  for (std::size_t i = 1; i < a.size(); ++i) less |= a[i] < b[i];
  return (less[0] | less[1]) != 0;
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

TriangleTree::RowValues TriangleTree::SquaredDistances(const Triangle& t, const Row& row) {
  RowValues to_edges, facing;  // facing < 0: the point is beyond some edge of the face
  to_edges.fill(Both(kInfinity));
  facing.fill(Both(t.degenerate ? -1.0 : 0.0));
  for (std::size_t k = 0; k < 3; ++k) {
    const double ex = t.edge[k].x(), ey = t.edge[k].y(), ez = t.edge[k].z();
    const double cx = t.corner[k].x(), fy = row.y - t.corner[k].y(), fz = row.z - t.corner[k].z();
    const double along_yz = fy * ey + fz * ez, inverse = t.inverse_squared_length[k];
    const double inward_x = t.inward[k].x();
    const double inward_yz = fy * t.inward[k].y() + fz * t.inward[k].z();
    for (std::size_t i = 0; i < to_edges.size(); ++i) {
      const Pair fx = PairOf(row, i) - cx;
      const Pair along = Min(Max((fx * ex + along_yz) * inverse, Both(0.0)), Both(1.0));
      const Pair dx = fx - along * ex, dy = fy - along * ey, dz = fz - along * ez;
      to_edges[i] = Min(dx * dx + dy * dy + dz * dz, to_edges[i]);
      facing[i] = Min(fx * inward_x + inward_yz, facing[i]);
    }
  }
  const double height_yz =
      (row.y - t.corner[0].y()) * t.normal.y() + (row.z - t.corner[0].z()) * t.normal.z();
  RowValues squared;
  for (std::size_t i = 0; i < squared.size(); ++i) {
    const Pair height = (PairOf(row, i) - t.corner[0].x()) * t.normal.x() + height_yz;
    squared[i] = facing[i] < 0.0 ? to_edges[i] : height * height;
  }
  return squared;
}

// The better of the box and the slab.
TriangleTree::RowValues TriangleTree::LowerBounds(const Node& node, const Row& row) {
  const double dy = std::max({node.min.y() - row.y, row.y - node.max.y(), 0.0});
  const double dz = std::max({node.min.z() - row.z, row.z - node.max.z(), 0.0});
  const double squared_yz = dy * dy + dz * dz;
  const double along_yz = node.axis.y() * row.y + node.axis.z() * row.z;
  RowValues bounds;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const Pair x = PairOf(row, i);
    const Pair dx = Max(Max(node.min.x() - x, x - node.max.x()), Both(0.0));
    const Pair along = node.axis.x() * x + along_yz;
    const Pair slab = Max(Max(node.axis_min - along, along - node.axis_max), Both(0.0));
    bounds[i] = Max(dx * dx + squared_yz, slab * slab);
  }
  return bounds;
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

TriangleTree::Hit TriangleTree::Nearest(const Eigen::Vector3d& point) const {
  Row row{{}, point.y(), point.z()};
  row.x.fill(point.x());
  return Nearest(row)[0];
}

std::array<TriangleTree::Hit, TriangleTree::kRowPoints> TriangleTree::Nearest(
    const Row& row, std::int32_t hint) const {
  RowValues best = SquaredDistances(triangles_[hint], row);
  std::array<std::int32_t, kRowPoints> owner;
  owner.fill(hint);
  double worst = Largest(best);
  const auto look_at = [&](std::int32_t triangle) {
    const RowValues squared = SquaredDistances(triangles_[triangle], row);
    if (!AnyLess(squared, best)) return;
    for (std::size_t i = 0; i < kRowPoints; ++i) {
      if (squared[i / 2][i % 2] < best[i / 2][i % 2]) owner[i] = triangle;
    }
    for (std::size_t i = 0; i < best.size(); ++i) best[i] = Min(squared[i], best[i]);
    worst = Largest(best);
  };
  struct Entry {
    double nearest;  // smallest bound of the points that need the node, else infinity
    std::int32_t node;
  };
  const auto enter = [&](std::int32_t node) {
    const RowValues bounds = LowerBounds(nodes_[node], row);
    Pair nearest = Both(kInfinity);
    for (std::size_t i = 0; i < best.size(); ++i) {
      nearest = Min(bounds[i] < best[i] ? bounds[i] : Both(kInfinity), nearest);
    }
    return Entry{std::min(nearest[0], nearest[1]), node};
  };
  std::array<Entry, 64> stack;  // halving 2^31 faces needs fewer
  std::size_t size = 0;
  stack[size++] = enter(0);
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.nearest >= worst) continue;
    const Node& node = nodes_[entry.node];
    if (node.count > 0) {
      for (std::int32_t t = node.first; t < node.first + node.count; ++t) look_at(t);
      continue;
    }
    Entry near = enter(node.first), far = enter(node.first + 1);
    if (far.nearest < near.nearest) std::swap(near, far);
    if (far.nearest < kInfinity) stack[size++] = far;
    if (near.nearest < kInfinity) stack[size++] = near;
  }
  std::array<Hit, kRowPoints> hits;
  for (std::size_t i = 0; i < kRowPoints; ++i) hits[i] = {best[i / 2][i % 2], owner[i]};
  return hits;
}

}  // namespace antigrasp
