#include "antigrasp/mesh/vertex_stars.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// The error of a triple product is below this times the largest components of its vectors, each
// with the error of one rounding: 42 roundings of 2^-53.
constexpr double kTripleError = 1e-14;
// Between these no product of three overflows or loses digits near zero.
constexpr double kSmall = 1e-90, kLarge = 1e90;

struct FaceShape {
  Vector3d cross, normal;  // twice the area times the unit normal, and that
  double open;             // a product with at most (1, 1, 1) that this exceeds has its sign
};

FaceShape ShapeOf(const TriangleMesh& mesh, std::size_t face) {
  const auto [a, b, c] = mesh.faces[face];
  const auto& v = mesh.vertices;
  const Vector3d u = v[b] - v[a], w = v[c] - v[a];
  const double size = std::max(u.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff());
  FaceShape shape{u.cross(w), Vector3d::Zero(), kLarge * kLarge};
  if (!(size > kSmall && size < kLarge)) return shape;
  shape.open = kTripleError * size * size;
  const double norm = shape.cross.norm();
  if (norm > 0.0) shape.normal = shape.cross / norm;
  return shape;
}

// The two other corners of a face, in its order.
struct Side {
  std::int32_t from, to;
};

Side SideOpposite(const std::array<std::int32_t, 3>& face, std::int32_t vertex) {
  std::size_t k = 0;
  while (face[k] != vertex) ++k;
  return {face[(k + 1) % 3], face[(k + 2) % 3]};
}

// On which side of the plane through `vertex`, along `view` and `ray`, whose product `normal` is,
// a vertex lies: 0 where rounding leaves it open.
int SideOfRay(const Vector3d& normal, double ray_size, const Vector3d& to) {
  const double size = std::max(ray_size, to.cwiseAbs().maxCoeff());
  if (!(size > kSmall && size < kLarge)) return 0;
  const double at = normal.dot(to), open = kTripleError * size * size;
  return (at > open) - (at < -open);
}

// Seen along `view` all faces turn the same way round the vertex, each by less than half a turn:
// whether they pass a ray between the first face's sides once.
bool OnceAround(const TriangleMesh& mesh, std::int32_t vertex, std::span<const Side> sides,
                const Vector3d& view) {
  const Vector3d& center = mesh.vertices[vertex];
  // Not halfway: there another vertex may lie opposite, by symmetry.
  const Vector3d ray = 0.625 * (mesh.vertices[sides[0].from] - center) +
                       0.375 * (mesh.vertices[sides[0].to] - center);
  const double ray_size = ray.cwiseAbs().maxCoeff();
  const Vector3d normal = view.cross(ray);
  int passed = 0;
  for (const Side& side : sides) {
    const int from = SideOfRay(normal, ray_size, mesh.vertices[side.from] - center);
    const int to = SideOfRay(normal, ray_size, mesh.vertices[side.to] - center);
    if (from == 0 || to == 0) return false;
    passed += from < 0 && to > 0;
  }
  return passed == 1;
}

class StarTest {
 public:
  explicit StarTest(const TriangleMesh& mesh) : mesh_(mesh), uses_(mesh.vertices.size(), 0) {
    shapes_.reserve(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) shapes_.push_back(ShapeOf(mesh, f));
  }

  bool IsPlain(std::int32_t vertex, std::span<const std::int32_t> faces) {
    if (faces.size() < 3) return false;
    Vector3d view = Vector3d::Zero();
    for (const std::int32_t face : faces) view += shapes_[face].normal;
    const double largest = view.cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) return false;
    view /= largest;
    sides_.clear();
    for (const std::int32_t face : faces) {
      if (!(view.dot(shapes_[face].cross) > shapes_[face].open)) return false;
      sides_.push_back(SideOpposite(mesh_.faces[face], vertex));
    }
    return Closed() && OnceAround(mesh_, vertex, sides_, view);
  }

 private:
  // Whether one side begins and one ends at every vertex around: closed fans.
  bool Closed() {
    constexpr std::int64_t kBegin = 1, kEnd = std::int64_t{1} << 32;
    for (const Side& side : sides_) {
      uses_[side.from] += kBegin;
      uses_[side.to] += kEnd;
    }
    const bool closed = std::all_of(sides_.begin(), sides_.end(), [&](const Side& side) {
      return uses_[side.from] == kBegin + kEnd && uses_[side.to] == kBegin + kEnd;
    });
    for (const Side& side : sides_) uses_[side.from] = uses_[side.to] = 0;
    return closed;
  }

  const TriangleMesh& mesh_;
  std::vector<FaceShape> shapes_;
  std::vector<Side> sides_;         // of the vertex that is looked at
  std::vector<std::int64_t> uses_;  // of its neighbours, 0 in between
};

}  // namespace

std::vector<char> PlainStars(const TriangleMesh& mesh) {
  std::vector<std::int32_t> end(mesh.vertices.size() + 1, 0);  // of a vertex's faces in `around`
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::int32_t v : mesh.faces[f]) ++end[v + 1];
  }
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];
  std::vector<std::int32_t> around(3 * mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::int32_t v : mesh.faces[f]) around[end[v]++] = static_cast<std::int32_t>(f);
  }
  StarTest test(mesh);
  std::vector<char> plain(mesh.vertices.size());
  std::int32_t begin = 0;
  for (std::size_t v = 0; v < plain.size(); ++v) {
    plain[v] = test.IsPlain(static_cast<std::int32_t>(v),
                            std::span(around).subspan(begin, end[v] - begin));
    begin = end[v];
  }
  return plain;
}

}  // namespace antigrasp
