#include "antigrasp/trial/gripped_body.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/mesh/mass_properties.h"

namespace antigrasp {
namespace {

// Principal axes as a rotation, moments rising. Signs are fixed, so that equal bodies turn alike:
// the largest component of the first two axes is positive.
Eigen::Matrix3d PrincipalAxes(const Eigen::Matrix3d& inertia, Eigen::Vector3d* moments) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
  *moments = solver.eigenvalues();
  Eigen::Matrix3d axes = solver.eigenvectors();
  for (int k = 0; k < 2; ++k) {
    Eigen::Index largest = 0;
    axes.col(k).cwiseAbs().maxCoeff(&largest);
    if (axes(largest, k) < 0.0) axes.col(k) = -axes.col(k);
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

TriangleMesh Moved(TriangleMesh mesh, const Eigen::Isometry3d& pose) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = pose * vertex;
  return mesh;
}

}  // namespace

GrippedBody MakeGrippedBody(const TriangleMesh& mesh) {
  const MassProperties mass = ComputeMassProperties(mesh);
  Eigen::Vector3d moments;
  const Eigen::Matrix3d axes = PrincipalAxes(mass.inertia, &moments);
  AG_CHECK(mass.volume > 0.0 && moments.x() > 0.0, "a solid with a volume");
  Eigen::Isometry3d from_object = Eigen::Isometry3d::Identity();
  from_object.linear() = axes.transpose();
  from_object.translation() = -(axes.transpose() * mass.center);
  const TriangleMesh moved = Moved(mesh, from_object);
  double radius = 0.0;
  for (const Eigen::Vector3d& vertex : moved.vertices) radius = std::max(radius, vertex.norm());
  return {ContactSolid(moved), from_object, mass.volume, moments, radius};
}

}  // namespace antigrasp
