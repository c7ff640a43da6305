// CGAL's predicates are seen here alone: they are slow to compile.
#include "antigrasp/mesh/face_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;

// A face with the corners that it shares in front, in the same order for both faces.
struct FaceCorners {
  std::array<Vector3d, 3> at;
  Point point(std::size_t i) const { return {at[i].x(), at[i].y(), at[i].z()}; }
  Triangle triangle() const { return {point(0), point(1), point(2)}; }
  Segment far_side() const { return {point(1), point(2)}; }
};

// Moves the shared corners of both faces to the front; their number.
int ShareFirst(const TriangleMesh& mesh, std::int32_t first, std::int32_t second, FaceCorners* f,
               FaceCorners* g) {
  auto a = mesh.faces[first], b = mesh.faces[second];
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
    if (found == b.end()) continue;
    std::swap(a[shared], a[i]);
    std::iter_swap(b.begin() + static_cast<std::ptrdiff_t>(shared), found);
    ++shared;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    f->at[i] = mesh.vertices[a[i]];
    g->at[i] = mesh.vertices[b[i]];
  }
  return static_cast<int>(shared);
}

// Whether all corners of g from `begin` on are certainly on one side of f's plane. The error of
// such a determinant is below 1e-14 times the cube of its largest coordinate difference.
bool OneSide(const FaceCorners& f, const FaceCorners& g, std::size_t begin) {
  const Vector3d u = f.at[1] - f.at[0], v = f.at[2] - f.at[0];
  const Vector3d normal = u.cross(v);
  const double flat = std::max(u.cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff());
  int above = 0, below = 0;
  for (std::size_t i = begin; i < 3; ++i) {
    const Vector3d w = g.at[i] - f.at[0];
    const double size = std::max(flat, w.cwiseAbs().maxCoeff());
    if (!(size > 1e-90)) return false;  // products near the least numbers lose digits
    const double height = normal.dot(w), error = 1e-14 * size * size * size;
    if (height > error) ++above;
    if (height < -error) ++below;
  }
  const int count = 3 - static_cast<int>(begin);
  return above == count || below == count;
}

// Twice the signed area of a, b, c along the axis between u and v, 0 where rounding leaves its sign
// open (Shewchuk, "Adaptive precision floating-point arithmetic", 1997).
double CertainTurn(const Vector3d& a, const Vector3d& b, const Vector3d& c, int u, int v) {
  const double left = (a[u] - c[u]) * (b[v] - c[v]), right = (a[v] - c[v]) * (b[u] - c[u]);
  const double turn = left - right;
  const double sum = std::abs(left) + std::abs(right);
  return sum > 1e-200 && std::abs(turn) > 4e-16 * sum ? turn : 0.0;
}

// Whether, seen along an axis, the line of a side of f that holds all shared corners certainly lies
// between the two: what they share then lies on the line.
bool SideBetween(const FaceCorners& f, const FaceCorners& g, std::size_t shared, int u, int v) {
  for (std::size_t away = shared; away < 3; ++away) {
    const Vector3d &a = f.at[(away + 1) % 3], &b = f.at[(away + 2) % 3];
    const double inside = CertainTurn(a, b, f.at[away], u, v);
    bool between = inside != 0.0;
    for (std::size_t i = shared; between && i < 3; ++i) {
      const double outside = CertainTurn(a, b, g.at[i], u, v);
      between = inside > 0.0 ? outside < 0.0 : outside > 0.0;
    }
    if (between) return true;
  }
  return false;
}

// For faces that lie in one plane, or nearly.
bool ApartInPlane(const FaceCorners& f, const FaceCorners& g, std::size_t shared) {
  int axis;
  (f.at[1] - f.at[0]).cross(f.at[2] - f.at[0]).cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return SideBetween(f, g, shared, u, v) || SideBetween(g, f, shared, u, v);
}

bool HasArea(const FaceCorners& f) { return !CGAL::collinear(f.point(0), f.point(1), f.point(2)); }

// Two faces on one edge overlap only when they lie in one plane on the same side of it.
bool FoldedFlat(const FaceCorners& f, const FaceCorners& g) {
  return CGAL::coplanar(f.point(0), f.point(1), f.point(2), g.point(2)) &&
         CGAL::coplanar_orientation(f.point(0), f.point(1), f.point(2), g.point(2)) ==
             CGAL::POSITIVE;
}

}  // namespace

bool FacesIntersect(const TriangleMesh& mesh, std::int32_t first, std::int32_t second) {
  FaceCorners f, g;
  const int shared = ShareFirst(mesh, first, second, &f, &g);
  if (shared == 3) return HasArea(f) && HasArea(g);
  const auto begin = static_cast<std::size_t>(shared);
  if (OneSide(f, g, begin) || OneSide(g, f, begin) || ApartInPlane(f, g, begin)) return false;
  if (!HasArea(f) || !HasArea(g)) return false;
  if (shared == 2) return FoldedFlat(f, g);
  if (shared == 0) return CGAL::do_intersect(f.triangle(), g.triangle());
  // They share one corner. Anything more they share reaches the far side of one of them.
  return CGAL::do_intersect(f.triangle(), g.far_side()) ||
         CGAL::do_intersect(g.triangle(), f.far_side());
}

}  // namespace antigrasp
