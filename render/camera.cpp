#include "antigrasp/render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/angles.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kMargin = 1.04;  // of the picture about the object

double LargestDistance(const TriangleMesh& mesh, const Vector3d& from) {
  double squared = 0.0;
  for (const Vector3d& v : mesh.vertices) squared = std::max(squared, (v - from).squaredNorm());
  return std::sqrt(squared);
}

}  // namespace

Eigen::Vector2d Camera::Project(const Vector3d& point) const {
  const Vector3d arm = (point - center) / (2.0 * half_side);
  return {0.5 + arm.dot(right), 0.5 - arm.dot(up)};
}

Camera CameraFor(const TriangleMesh& mesh, double azimuth, double elevation) {
  const double a = azimuth * kDegree, e = elevation * kDegree;
  Camera camera;
  camera.forward = -Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
  camera.right = Vector3d(-std::sin(a), std::cos(a), 0.0);
  camera.up = camera.right.cross(camera.forward);
  const BoundingBox box = Bounds(mesh);
  camera.center = 0.5 * (box.min + box.max);
  const double radius = LargestDistance(mesh, camera.center);
  camera.half_side = radius > 0.0 ? kMargin * radius : 1.0;
  return camera;
}

}  // namespace antigrasp
