// The only file that sees CGAL's simplification: its headers are slow to compile.
#include "antigrasp/perturb/decimate.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "antigrasp/core/check.h"
#include "antigrasp/perturb/validity.h"

namespace antigrasp {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

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
  return InSinglePrecision(out);
}

// Every closed triangle mesh has three edges for two faces.
sms::Count_stop_predicate<SurfaceMesh> FewerFacesThan(int faces) {
  return sms::Count_stop_predicate<SurfaceMesh>(static_cast<std::size_t>(faces) * 3 / 2);
}

TriangleMesh ByLindstromTurk(const TriangleMesh& mesh, int faces) {
  SurfaceMesh work = ToSurfaceMesh(mesh);
  sms::edge_collapse(work, FewerFacesThan(faces),
                     CGAL::parameters::get_cost(sms::LindstromTurk_cost<SurfaceMesh>())
                         .get_placement(sms::LindstromTurk_placement<SurfaceMesh>())
                         .filter(sms::Bounded_normal_change_filter<>()));
  return FromSurfaceMesh(&work);
}

TriangleMesh ByGarlandHeckbert(const TriangleMesh& mesh, int faces) {
  SurfaceMesh work = ToSurfaceMesh(mesh);
  const sms::GarlandHeckbert_plane_policies<SurfaceMesh, Kernel> policies(work);
  sms::edge_collapse(work, FewerFacesThan(faces),
                     CGAL::parameters::get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         .filter(sms::Bounded_normal_change_filter<>()));
  return FromSurfaceMesh(&work);
}

}  // namespace

DecimateResult Decimate(const TriangleMesh& mesh, int faces) {
  if (static_cast<int>(mesh.faces.size()) <= faces) {
    DecimateResult same{InSinglePrecision(mesh), ""};
    same.failure = WhyNotPrintable(same.mesh);
    return same;
  }
  DecimateResult result{ByLindstromTurk(mesh, faces), ""};
  result.failure = WhyNotPrintable(result.mesh);
  if (result.failure.empty()) return result;
  result.mesh = ByGarlandHeckbert(mesh, faces);
  result.failure = WhyNotPrintable(result.mesh);
  return result;
}

}  // namespace antigrasp
