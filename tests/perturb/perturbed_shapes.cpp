#include "tests/perturb/perturbed_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace antigrasp::shapes {

using Eigen::Vector3d;

TriangleMesh RegularTetrahedron() {
  const double s = 1.0 / std::sqrt(3.0);
  return {{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}},
          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

// The vertices of the dual icosahedron are the pentagons' normals.
TriangleMesh Dodecahedron() {
  const double g = std::numbers::phi, scale = 1.0 / std::sqrt(3.0);
  TriangleMesh mesh;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) mesh.vertices.push_back(scale * Vector3d(x, y, z));
      mesh.vertices.push_back(scale * Vector3d(0, x / g, y * g));
      mesh.vertices.push_back(scale * Vector3d(x / g, y * g, 0));
      mesh.vertices.push_back(scale * Vector3d(x * g, 0, y / g));
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        Vector3d normal = Vector3d::Zero();
        normal[axis] = a;
        normal[(axis + 2) % 3] = b * g;
        normal.normalize();
        std::vector<std::int32_t> ring;
        double top = -1.0;
        for (const Vector3d& v : mesh.vertices) top = std::max(top, normal.dot(v));
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
          if (normal.dot(mesh.vertices[v]) > top - 1e-9) {
            ring.push_back(static_cast<std::int32_t>(v));
          }
        }
        const Vector3d side = (mesh.vertices[ring[0]] - top * normal).normalized();
        const auto angle = [&](std::int32_t v) {
          return std::atan2(mesh.vertices[v].dot(normal.cross(side)), mesh.vertices[v].dot(side));
        };
        std::sort(ring.begin(), ring.end(),
                  [&](std::int32_t v, std::int32_t w) { return angle(v) < angle(w); });
        for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
          mesh.faces.push_back({ring[0], ring[k], ring[k + 1]});
        }
      }
    }
  }
  return mesh;
}

TriangleMesh Triangles(const std::vector<std::array<Vector3d, 3>>& triangles) {
  TriangleMesh mesh;
  for (const auto& triangle : triangles) {
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.faces.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

TriangleMesh Shaken(TriangleMesh mesh, double size, RngStream* rng) {
  for (Vector3d& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) v[k] += rng->Uniform(-size, size);
  }
  return mesh;
}

Eigen::Matrix3d RandomRotation(RngStream* rng) {
  const Vector3d axis(rng->Normal(), rng->Normal(), rng->Normal());
  return Eigen::AngleAxisd(rng->Uniform(0.0, 2.0 * std::numbers::pi), axis.normalized())
      .toRotationMatrix();
}

}  // namespace antigrasp::shapes
