#include "antigrasp/perturb/search_projection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A face is turned this share of the angle further than to the rim, so that neighbours that pull it
// back a little do not keep the sweeps going.
constexpr double kInside = 2e-3;

// A face turned further than this many times the angle is put back instead: a sliver turned over
// would otherwise come back the long way and drag its neighbours.
constexpr double kFar = 3.0;

using Face = std::array<std::int32_t, 3>;

// The corners all move by the mean of what they had moved: the normal is as it was.
void MoveAlike(const TriangleMesh& start, const Face& face, TriangleMesh* mesh) {
  Vector3d mean = Vector3d::Zero();
  for (const std::int32_t corner : face) {
    const auto v = static_cast<std::size_t>(corner);
    mean += (mesh->vertices[v] - start.vertices[v]) / 3.0;
  }
  for (const std::int32_t corner : face) {
    const auto v = static_cast<std::size_t>(corner);
    mesh->vertices[v] = start.vertices[v] + mean;
  }
}

void Turn(const Face& face, double angle, const Vector3d& axis, TriangleMesh* mesh) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  Vector3d centroid = Vector3d::Zero();
  for (const std::int32_t v : face) centroid += mesh->vertices[static_cast<std::size_t>(v)] / 3.0;
  for (const std::int32_t v : face) {
    Vector3d& corner = mesh->vertices[static_cast<std::size_t>(v)];
    corner = centroid + rotation * (corner - centroid);
  }
}

}  // namespace

int TurnBack(const TriangleMesh& start, const std::vector<Vector3d>& start_normals, double angle,
             int sweeps, TriangleMesh* mesh) {
  const double cosine = std::cos(angle);
  int outside = 0;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    outside = 0;
    for (std::size_t f = 0; f < mesh->faces.size(); ++f) {
      const Vector3d normal = FaceCross(*mesh, f).normalized();
      if (normal.dot(start_normals[f]) >= cosine) continue;
      ++outside;
      const Vector3d axis = normal.cross(start_normals[f]);
      const double turn = std::atan2(axis.norm(), normal.dot(start_normals[f]));
      if (turn > kFar * angle) {
        MoveAlike(start, mesh->faces[f], mesh);
      } else {
        Turn(mesh->faces[f], turn - (1.0 - kInside) * angle, axis.normalized(), mesh);
      }
    }
    if (outside == 0) break;
  }
  return outside;
}

double LargestTurn(const TriangleMesh& mesh, const std::vector<Vector3d>& start_normals) {
  double largest = 0.0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vector3d normal = FaceCross(mesh, f).normalized();
    if (normal.isZero()) return std::numbers::pi;
    const Vector3d& start = start_normals[f];
    largest = std::max(largest, std::atan2(normal.cross(start).norm(), normal.dot(start)));
  }
  return largest;
}

}  // namespace antigrasp
