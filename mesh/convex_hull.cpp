#include "antigrasp/mesh/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "antigrasp/mesh/topology.h"

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

Point PointAt(const TriangleMesh& mesh, std::int32_t vertex) {
  const Eigen::Vector3d& v = mesh.vertices[static_cast<std::size_t>(vertex)];
  return {v.x(), v.y(), v.z()};
}

// Of every face the number of its facet: faces that hang together in one plane, exactly.
std::vector<int> FacetsOf(const TriangleMesh& hull, const std::vector<EdgeUse>& uses) {
  std::vector<int> parent(hull.faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int face) {
    while (parent[static_cast<std::size_t>(face)] != face) {
      face = parent[static_cast<std::size_t>(face)];
    }
    return face;
  };
  ForEachEdge(uses, [&](auto first, auto) {
    const auto& f = hull.faces[static_cast<std::size_t>(first[0].face)];
    const auto& g = hull.faces[static_cast<std::size_t>(first[1].face)];
    const auto other = std::find_if(g.begin(), g.end(), [&](std::int32_t v) {
      return v != first[0].low && v != first[0].high;
    });
    if (CGAL::orientation(PointAt(hull, f[0]), PointAt(hull, f[1]), PointAt(hull, f[2]),
                          PointAt(hull, *other)) == CGAL::COPLANAR) {
      const int a = root(first[0].face), b = root(first[1].face);
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  });
  for (std::size_t f = 0; f < parent.size(); ++f) parent[f] = root(static_cast<int>(f));
  return parent;
}

// The border of every facet as the vertex after each, counter-clockwise.
using Border = std::map<std::int32_t, std::int32_t>;
std::map<int, Border> BordersOf(const TriangleMesh& hull) {
  const std::vector<EdgeUse> uses = SortedEdgeUses(hull);
  const std::vector<int> facets = FacetsOf(hull, uses);
  std::map<int, Border> borders;
  ForEachEdge(uses, [&](auto first, auto) {
    const int a = facets[static_cast<std::size_t>(first[0].face)],
              b = facets[static_cast<std::size_t>(first[1].face)];
    if (a == b) return;
    for (const EdgeUse& use : {first[0], first[1]}) {
      const int facet = facets[static_cast<std::size_t>(use.face)];
      borders[facet][use.forward ? use.low : use.high] = use.forward ? use.high : use.low;
    }
  });
  return borders;
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

TriangleMesh ConvexHullOfCorners(const std::vector<Eigen::Vector3d>& points) {
  const TriangleMesh hull = ConvexHull(points);
  if (hull.faces.empty()) return {};
  const std::map<int, Border> borders = BordersOf(hull);
  std::vector<int> facets_at(hull.vertices.size(), 0);
  for (const auto& [facet, border] : borders) {
    for (const auto& [vertex, next] : border) ++facets_at[static_cast<std::size_t>(vertex)];
  }
  TriangleMesh corners;
  std::vector<std::int32_t> number(hull.vertices.size(), -1);
  for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
    if (facets_at[v] < 3) continue;  // on an edge
    number[v] = static_cast<std::int32_t>(corners.vertices.size());
    corners.vertices.push_back(hull.vertices[v]);
  }
  for (const auto& [facet, border] : borders) {
    std::vector<std::int32_t> polygon;
    const std::int32_t start = border.begin()->first;
    std::int32_t vertex = start;
    do {
      const std::int32_t own = number[static_cast<std::size_t>(vertex)];
      if (own >= 0) polygon.push_back(own);
      vertex = border.at(vertex);
    } while (vertex != start);
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      corners.faces.push_back({polygon[0], polygon[k], polygon[k + 1]});
    }
  }
  std::sort(corners.faces.begin(), corners.faces.end());
  return corners;
}

}  // namespace antigrasp
