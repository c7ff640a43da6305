#include "antigrasp/mesh/mesh_union.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

namespace antigrasp {
namespace {

using ExactPoint = CGAL::Exact_predicates_exact_constructions_kernel::Point_3;
using ExactMesh = CGAL::Surface_mesh<ExactPoint>;
namespace corefinement = CGAL::Polygon_mesh_processing;

// Nothing of a mesh that is not manifold: CGAL adds no third face to an edge, and no second fan to
// a vertex.
std::optional<ExactMesh> ToExactMesh(const TriangleMesh& mesh) {
  ExactMesh surface;
  for (const auto& v : mesh.vertices) surface.add_vertex(ExactPoint(v.x(), v.y(), v.z()));
  using Vertex = ExactMesh::Vertex_index;
  for (const auto& [a, b, c] : mesh.faces) {
    const auto face = surface.add_face(Vertex(a), Vertex(b), Vertex(c));
    if (face == ExactMesh::null_face()) return std::nullopt;
  }
  return surface;
}

// The double next to the exact value: of a lazy number CGAL gives one that depends on what has been
// asked of it before.
double Rounded(const CGAL::Epeck::FT& value) { return CGAL::to_double(value.exact()); }

TriangleMesh ToTriangleMesh(const ExactMesh& surface) {
  TriangleMesh mesh;
  std::vector<std::int32_t> number(surface.num_vertices());
  for (const auto vertex : surface.vertices()) {
    number[vertex.idx()] = static_cast<std::int32_t>(mesh.vertices.size());
    const ExactPoint& p = surface.point(vertex);
    mesh.vertices.emplace_back(Rounded(p.x()), Rounded(p.y()), Rounded(p.z()));
  }
  for (const auto face : surface.faces()) {
    std::array<std::int32_t, 3> corners{};
    std::size_t k = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
      corners[k++] = number[vertex.idx()];
    }
    mesh.faces.push_back(corners);
  }
  return mesh;
}

}  // namespace

std::optional<TriangleMesh> Union(const std::vector<TriangleMesh>& meshes) {
  std::optional<ExactMesh> whole = ToExactMesh(meshes.front());
  for (std::size_t i = 1; whole && i < meshes.size(); ++i) {
    std::optional<ExactMesh> part = ToExactMesh(meshes[i]);
    if (!part) return std::nullopt;
    ExactMesh both;
    try {
      if (!corefinement::corefine_and_compute_union(
              *whole, *part, both, CGAL::parameters::throw_on_self_intersection(true))) {
        return std::nullopt;
      }
    } catch (const corefinement::Corefinement::Self_intersection_exception&) {
      return std::nullopt;
    }
    whole = std::move(both);
  }
  if (!whole) return std::nullopt;
  whole->collect_garbage();
  return ToTriangleMesh(*whole);
}

}  // namespace antigrasp
