#include "antigrasp/mesh/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>

namespace antigrasp {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;

// Vertices and faces in an order of their own: CGAL's follows from addresses, and with it the last
// bits of every sum over the hull would change from call to call.
TriangleMesh ToTriangleMesh(const SurfaceMesh& hull) {
  std::vector<SurfaceMesh::Vertex_index> order(hull.vertices().begin(), hull.vertices().end());
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return hull.point(a) < hull.point(b); });
  std::vector<std::int32_t> number(hull.number_of_vertices());
  TriangleMesh mesh;
  for (const auto vertex : order) {
    number[vertex.idx()] = static_cast<std::int32_t>(mesh.vertices.size());
    const Point& p = hull.point(vertex);
    mesh.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto face : hull.faces()) {
    std::array<std::int32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto vertex : hull.vertices_around_face(hull.halfedge(face))) {
      if (k < 3) corners[k] = number[vertex.idx()];
      ++k;
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    mesh.faces.push_back(corners);
  }
  std::sort(mesh.faces.begin(), mesh.faces.end());
  return mesh;
}

}  // namespace

TriangleMesh ConvexHull(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Point> input;
  input.reserve(points.size());
  for (const auto& p : points) input.emplace_back(p.x(), p.y(), p.z());
  if (input.size() < 4) return {};
  SurfaceMesh hull;
  CGAL::convex_hull_3(input.begin(), input.end(), hull);
  // Points in a plane come back as one flat face, points on a line as two vertices.
  if (hull.number_of_faces() < 4 || !CGAL::is_closed(hull)) return {};
  return ToTriangleMesh(hull);
}

}  // namespace antigrasp
