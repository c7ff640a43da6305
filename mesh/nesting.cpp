#include "antigrasp/mesh/nesting.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;

constexpr std::uint64_t kMostWays = 64;

bool Holds(const Box& outer, const Box& inner) {
  for (int k = 0; k < 3; ++k) {
    if (!(outer.min_coord(k) < inner.min_coord(k) && inner.max_coord(k) < outer.max_coord(k))) {
      return false;
    }
  }
  return true;
}

Point ToPoint(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::vector<Box> BoxesOf(const TriangleMesh& mesh, const Pieces& pieces) {
  std::vector<CGAL::Bbox_3> bounds(pieces.count);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::int32_t v : mesh.faces[f]) {
      bounds[pieces.of_face[f]] += ToPoint(mesh.vertices[v]).bbox();
    }
  }
  std::vector<Box> boxes;
  for (std::int32_t p = 0; p < pieces.count; ++p) boxes.emplace_back(bounds[p], p);
  return boxes;
}

// For every piece the ones that its box holds, in ascending order.
std::vector<std::vector<std::int32_t>> HeldPieces(std::vector<Box> boxes,
                                                  const std::vector<std::int32_t>& group) {
  std::vector<std::vector<std::int32_t>> held(boxes.size());
  const auto note = [&](const Box& outer, const Box& inner) {
    if (group[outer.info()] != group[inner.info()] && Holds(outer, inner)) {
      held[outer.info()].push_back(inner.info());
    }
  };
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    note(a, b);
    note(b, a);
  });
  for (auto& inner : held) std::sort(inner.begin(), inner.end());
  return held;
}

std::vector<Triangle> TrianglesOf(const TriangleMesh& mesh, const std::vector<std::size_t>& faces) {
  std::vector<Triangle> triangles;
  for (const std::size_t f : faces) {
    const auto& [a, b, c] = mesh.faces[f];
    const Triangle triangle(ToPoint(mesh.vertices[a]), ToPoint(mesh.vertices[b]),
                            ToPoint(mesh.vertices[c]));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);  // a slit that no ray meets
  }
  return triangles;
}

// Whether a way from the point to far outside crosses the faces an odd number of times. A way that
// meets an edge or a corner says nothing, and another one is taken. (CGAL's Side_of_triangle_mesh
// needs neighbours that agree.) No for a point on a face.
bool Encloses(const Tree& tree, const Point& point) {
  const CGAL::Bbox_3 box = tree.bbox();
  const Eigen::Vector3d low(box.xmin(), box.ymin(), box.zmin());
  const Eigen::Vector3d high(box.xmax(), box.ymax(), box.zmax());
  for (std::uint64_t way = 0; way < kMostWays; ++way) {
    RngStream rng(0, "nesting", way);
    const Eigen::Vector3d direction(rng.Normal(), rng.Normal(), rng.Normal());
    const Point far = ToPoint(0.5 * (low + high) + (high - low).norm() * direction.normalized());
    std::vector<Tree::Primitive_id> met;
    tree.all_intersected_primitives(Kernel::Segment_3(point, far), std::back_inserter(met));
    const bool clear = std::all_of(met.begin(), met.end(), [&](const auto& face) {
      return CGAL::orientation(point, far, (*face)[0], (*face)[1]) != CGAL::COPLANAR &&
             CGAL::orientation(point, far, (*face)[1], (*face)[2]) != CGAL::COPLANAR &&
             CGAL::orientation(point, far, (*face)[2], (*face)[0]) != CGAL::COPLANAR &&
             !face->has_on(point);
    });
    if (clear) return met.size() % 2 == 1;
  }
  return false;
}

}  // namespace

std::vector<int> NestingDepths(const TriangleMesh& mesh, const Pieces& pieces,
                               const std::vector<std::int32_t>& group) {
  std::vector<int> depths(pieces.count, 0);
  if (pieces.count < 2) return depths;
  const auto held = HeldPieces(BoxesOf(mesh, pieces), group);
  std::vector<std::vector<std::size_t>> faces(pieces.count);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) faces[pieces.of_face[f]].push_back(f);
  for (std::size_t outer = 0; outer < held.size(); ++outer) {
    if (held[outer].empty()) continue;
    const std::vector<Triangle> triangles = TrianglesOf(mesh, faces[outer]);
    if (triangles.empty()) continue;
    const Tree tree(triangles.begin(), triangles.end());
    for (const std::int32_t inner : held[outer]) {
      const std::int32_t corner = mesh.faces[faces[inner].front()][0];
      if (Encloses(tree, ToPoint(mesh.vertices[corner]))) ++depths[inner];
    }
  }
  return depths;
}

std::vector<int> NestingDepths(const TriangleMesh& mesh, const Pieces& pieces) {
  std::vector<std::int32_t> group(pieces.count);
  std::iota(group.begin(), group.end(), 0);
  return NestingDepths(mesh, pieces, group);
}

}  // namespace antigrasp
