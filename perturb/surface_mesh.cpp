#include "antigrasp/perturb/surface_mesh.h"

#include "antigrasp/core/check.h"

namespace antigrasp {

SurfaceMesh ToSurfaceMesh(const TriangleMesh& mesh) {
  SurfaceMesh out;
  std::vector<SurfaceMesh::Vertex_index> vertices;
  for (const auto& v : mesh.vertices) vertices.push_back(out.add_vertex({v.x(), v.y(), v.z()}));
  for (const auto& f : mesh.faces) {
    const auto face = out.add_face(vertices[f[0]], vertices[f[1]], vertices[f[2]]);
    AG_CHECK(face != SurfaceMesh::null_face(), "a manifold, oriented mesh");
  }
  return out;
}

TriangleMesh FromSurfaceMesh(SurfaceMesh* mesh) {
  mesh->collect_garbage();  // indices without holes
  TriangleMesh out;
  for (const auto v : mesh->vertices()) {
    const auto& p = mesh->point(v);
    out.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh->faces()) {
    std::array<std::int32_t, 3> face{};
    std::size_t k = 0;
    for (const auto v : mesh->vertices_around_face(mesh->halfedge(f))) {
      face[k++] = static_cast<std::int32_t>(v.idx());
    }
    out.faces.push_back(face);
  }
  return out;
}

}  // namespace antigrasp
