#include "antigrasp/mesh/mass_properties.h"

#include <Eigen/Geometry>

namespace antigrasp {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A tetrahedron with corners 0, a, b, c and six times the volume d has
// integral of x x^T = d / 120 (a a^T + b b^T + c c^T + s s^T), s = a + b + c.
MassProperties ComputeMassProperties(const TriangleMesh& mesh) {
  MassProperties properties;
  properties.volume = Volume(mesh);
  properties.center = CenterOfMass(mesh);
  Matrix3d second = Matrix3d::Zero();
  for (const auto& face : mesh.faces) {
    const Vector3d a = mesh.vertices[face[0]] - properties.center;
    const Vector3d b = mesh.vertices[face[1]] - properties.center;
    const Vector3d c = mesh.vertices[face[2]] - properties.center;
    const Vector3d sum = a + b + c;
    second += a.dot(b.cross(c)) / 120.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  properties.inertia = second.trace() * Matrix3d::Identity() - second;
  return properties;
}

}  // namespace antigrasp
