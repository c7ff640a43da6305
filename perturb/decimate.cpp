// The only file that sees CGAL's simplification: its headers are slow to compile.
#include "antigrasp/perturb/decimate.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "antigrasp/perturb/surface_mesh.h"
#include "antigrasp/perturb/validity.h"

namespace antigrasp {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
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
  return InSinglePrecision(FromSurfaceMesh(&work));
}

TriangleMesh ByGarlandHeckbert(const TriangleMesh& mesh, int faces) {
  SurfaceMesh work = ToSurfaceMesh(mesh);
  const sms::GarlandHeckbert_plane_policies<SurfaceMesh, SurfaceKernel> policies(work);
  sms::edge_collapse(work, FewerFacesThan(faces),
                     CGAL::parameters::get_cost(policies.get_cost())
                         .get_placement(policies.get_placement())
                         .filter(sms::Bounded_normal_change_filter<>()));
  return InSinglePrecision(FromSurfaceMesh(&work));
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
