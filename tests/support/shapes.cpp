#include "tests/support/shapes.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

namespace antigrasp::shapes {
namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;

TriangleMesh Icosahedron() {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  TriangleMesh mesh;
  mesh.vertices = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                   {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

TriangleMesh Subdivided(const TriangleMesh& coarse) {
  TriangleMesh fine;
  fine.vertices = coarse.vertices;
  std::map<Edge, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), fine.vertices.size());
    if (is_new) fine.vertices.push_back(0.5 * (coarse.vertices[a] + coarse.vertices[b]));
    return it->second;
  };
  for (const auto& [a, b, c] : coarse.faces) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    fine.faces.insert(fine.faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  return fine;
}

}  // namespace

TriangleMesh Sphere(double radius, int subdivisions) {
  TriangleMesh mesh = Icosahedron();
  for (int level = 0; level < subdivisions; ++level) {
    mesh = Subdivided(mesh);
    for (auto& v : mesh.vertices) v.normalize();
  }
  for (auto& v : mesh.vertices) v = radius * v.normalized();
  return mesh;
}

TriangleMesh Box(const Eigen::Vector3d& extents) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1, (i >> 1) & 1, i >> 2);
    mesh.vertices.push_back((corner.array() - 0.5) * extents.array());
  }
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh Cube() { return Box(Eigen::Vector3d::Ones()); }

TriangleMesh Tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}};
}

TriangleMesh Torus(double ring, double tube, int n, int m) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n;
    for (int j = 0; j < m; ++j) {
      const double v = 2.0 * std::numbers::pi * j / m;
      const double r = ring + tube * std::cos(v);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
      const int a = i * m + j, b = (i + 1) % n * m + j;
      const int c = (i + 1) % n * m + (j + 1) % m, d = i * m + (j + 1) % m;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  }
  return mesh;
}

TriangleMesh Cylinder(double radius, double height, int n) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, -0.5 * height}, {0, 0, 0.5 * height}};
  for (int i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n;
    const double x = radius * std::cos(u), y = radius * std::sin(u);
    mesh.vertices.push_back({x, y, -0.5 * height});
    mesh.vertices.push_back({x, y, 0.5 * height});
    const int low = 2 + 2 * i, next_low = 2 + 2 * ((i + 1) % n);
    const int high = low + 1, next_high = next_low + 1;
    mesh.faces.push_back({0, next_low, low});
    mesh.faces.push_back({1, high, next_high});
    mesh.faces.push_back({low, next_low, next_high});
    mesh.faces.push_back({low, next_high, high});
  }
  return mesh;
}

TriangleMesh FlatSquare() {
  return {{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}},
          {{{0, 1, 2}, {0, 2, 3}}}};
}

TriangleMesh Rotated(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation) {
  TriangleMesh out = mesh;
  for (auto& v : out.vertices) v = rotation * v;
  return out;
}

TriangleMesh Inverted(const TriangleMesh& mesh) {
  TriangleMesh out = mesh;
  for (auto& face : out.faces) std::swap(face[1], face[2]);
  return out;
}

TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh out = a;
  const auto offset = static_cast<std::int32_t>(a.vertices.size());
  out.vertices.insert(out.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& f : b.faces) out.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
  return out;
}

}  // namespace antigrasp::shapes
