#include "tests/support/contact_shapes.h"

#include <map>
#include <utility>

#include "antigrasp/core/rng.h"
#include "tests/support/shapes.h"

namespace antigrasp::shapes {

TriangleMesh Extruded(const std::vector<Eigen::Vector2d>& polygon,
                      const std::vector<std::array<int, 3>>& triangles, double height) {
  TriangleMesh mesh;
  const int n = static_cast<int>(polygon.size());
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const Eigen::Vector2d& p : polygon) mesh.vertices.push_back({p.x(), p.y(), z});
  }
  for (const auto& [a, b, c] : triangles) {
    mesh.faces.push_back({a, c, b});
    mesh.faces.push_back({n + a, n + b, n + c});
  }
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    mesh.faces.push_back({i, next, n + next});
    mesh.faces.push_back({i, n + next, n + i});
  }
  return mesh;
}

TriangleMesh Subdivided(const TriangleMesh& mesh, int times) {
  if (times == 0) return mesh;
  TriangleMesh finer;
  finer.vertices = mesh.vertices;
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(finer.vertices.size()));
    if (is_new) finer.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.faces) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& face : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
      finer.faces.push_back(face);
    }
  }
  return Subdivided(finer, times - 1);
}

TriangleMesh Bumpy(double radius, int subdivisions, std::uint64_t seed) {
  TriangleMesh mesh = Sphere(radius, subdivisions);
  RngStream rng(seed, "bumpy");
  for (Eigen::Vector3d& v : mesh.vertices) v *= rng.Uniform(0.9, 1.1);
  return mesh;
}

}  // namespace antigrasp::shapes
