#include "antigrasp/mesh/triangle_mesh.h"

#include <Eigen/Geometry>
#include <cmath>

namespace antigrasp {
namespace {

// Below this share of the bounding box a volume is rounding noise: the mesh is a flat or open
// surface and has no meaningful solid centre.
constexpr double kFlatVolume = 1e-12;

}  // namespace

BoundingBox Bounds(const TriangleMesh& mesh) {
  BoundingBox box;
  if (mesh.vertices.empty()) return box;
  box.min = box.max = mesh.vertices.front();
  for (const Eigen::Vector3d& v : mesh.vertices) {
    box.min = box.min.cwiseMin(v);
    box.max = box.max.cwiseMax(v);
  }
  return box;
}

Eigen::Vector3d FaceCross(const TriangleMesh& mesh, std::size_t face) {
  const auto& f = mesh.faces[face];
  const Eigen::Vector3d& a = mesh.vertices[f[0]];
  return (mesh.vertices[f[1]] - a).cross(mesh.vertices[f[2]] - a);
}

double SurfaceArea(const TriangleMesh& mesh) {
  double twice_area = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) twice_area += FaceCross(mesh, f).norm();
  return 0.5 * twice_area;
}

// Both solid integrals are taken about the middle of the bounding box: far from the origin the
// signed tetrahedra would cancel and lose digits.
double Volume(const TriangleMesh& mesh) {
  const Eigen::Vector3d origin = Bounds(mesh).Center();
  double six_volume = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    six_volume += (mesh.vertices[mesh.faces[f][0]] - origin).dot(FaceCross(mesh, f));
  }
  return six_volume / 6.0;
}

Eigen::Vector3d CenterOfMass(const TriangleMesh& mesh) {
  const BoundingBox box = Bounds(mesh);
  const Eigen::Vector3d origin = box.Center();
  Eigen::Vector3d solid_moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d surface_moment = Eigen::Vector3d::Zero();
  double six_volume = 0.0;
  double twice_area = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& face = mesh.faces[f];
    const Eigen::Vector3d a = mesh.vertices[face[0]] - origin;
    const Eigen::Vector3d sum =
        a + (mesh.vertices[face[1]] - origin) + (mesh.vertices[face[2]] - origin);
    const Eigen::Vector3d cross = FaceCross(mesh, f);
    const double six_tetrahedron = a.dot(cross);
    six_volume += six_tetrahedron;
    solid_moment += six_tetrahedron * sum / 4.0;
    twice_area += cross.norm();
    surface_moment += cross.norm() * sum / 3.0;
  }
  const double box_size = box.Extent().norm();
  if (std::abs(six_volume) > kFlatVolume * box_size * box_size * box_size) {
    const Eigen::Vector3d center = solid_moment / six_volume;
    // Where parts of a mesh are inside out, volumes of both signs put it anywhere.
    if ((center.cwiseAbs().array() <= 0.5 * box.Extent().array()).all()) return origin + center;
  }
  return twice_area > 0.0 ? Eigen::Vector3d(origin + surface_moment / twice_area) : origin;
}

TriangleMesh Transformed(const TriangleMesh& mesh, double scale,
                         const Eigen::Vector3d& translation) {
  TriangleMesh out = mesh;
  for (Eigen::Vector3d& v : out.vertices) v = scale * v + translation;
  return out;
}

}  // namespace antigrasp
