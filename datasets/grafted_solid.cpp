#include "antigrasp/datasets/grafted_solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;  // convex, flat

// Faces of two parts that lie in one plane are both bare, whatever rounding says.
constexpr double kFlush = 1e-9;

struct Plane {
  Vector3d normal;  // outward
  double offset;
  double Height(const Vector3d& p) const { return normal.dot(p) - offset; }
};

struct Polyhedron {
  std::vector<Polygon> faces;
  std::vector<Plane> planes;  // of the faces
};

Vector3d ToLocal(const Primitive& part, const Vector3d& p) {
  return part.axes.transpose() * (p - part.center);
}

// The profile of a prism along z: a rectangle, or a polygon inscribed in the cylinder.
std::vector<Vector3d> Ring(const Primitive& part) {
  const Vector3d& h = part.half;
  if (part.shape == Primitive::Shape::kBox) {
    return {{h.x(), h.y(), 0}, {-h.x(), h.y(), 0}, {-h.x(), -h.y(), 0}, {h.x(), -h.y(), 0}};
  }
  std::vector<Vector3d> ring;
  for (int i = 0; i < GraftedSolid::kSegments; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / GraftedSolid::kSegments;
    ring.emplace_back(h.x() * std::cos(angle), h.x() * std::sin(angle), 0.0);
  }
  return ring;
}

Polyhedron Facets(const Primitive& part) {
  const std::vector<Vector3d> ring = Ring(part);
  const Vector3d up(0, 0, part.half.z());
  Polyhedron solid;
  Polygon top, bottom;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector3d &a = ring[i], &b = ring[(i + 1) % ring.size()];
    solid.faces.push_back({a - up, b - up, b + up, a + up});
    top.push_back(a + up);
    bottom.insert(bottom.begin(), a - up);
  }
  solid.faces.push_back(top);
  solid.faces.push_back(bottom);
  for (Polygon& face : solid.faces) {
    for (Vector3d& p : face) p = part.center + part.axes * p;
    const Vector3d normal = (face[1] - face[0]).cross(face[2] - face[1]).normalized();
    solid.planes.push_back({normal, normal.dot(face[0])});
  }
  return solid;
}

// Cuts a polygon: the piece in front of the plane (outside), and what is left behind it.
std::pair<Polygon, Polygon> Cut(const Polygon& polygon, const Plane& plane) {
  Polygon front, behind;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double height_a = plane.Height(a), height_b = plane.Height(b);
    (height_a > 0.0 ? front : behind).push_back(a);
    if ((height_a > 0.0) == (height_b > 0.0)) continue;
    const Vector3d crossing = a + height_a / (height_a - height_b) * (b - a);
    front.push_back(crossing);
    behind.push_back(crossing);
  }
  if (front.size() < 3) front.clear();
  if (behind.size() < 3) behind.clear();
  return {front, behind};
}

// The pieces of a polygon outside a convex solid.
std::vector<Polygon> OutsideOf(const Polygon& polygon, const Polyhedron& solid) {
  const auto in_front = [&](const Plane& plane) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Vector3d& p) { return plane.Height(p) >= -kFlush; });
  };
  if (std::any_of(solid.planes.begin(), solid.planes.end(), in_front)) return {polygon};
  std::vector<Polygon> pieces;
  Polygon rest = polygon;
  for (const Plane& plane : solid.planes) {
    auto [front, behind] = Cut(rest, plane);
    if (!front.empty()) pieces.push_back(std::move(front));
    rest = std::move(behind);
    if (rest.empty()) break;
  }
  return pieces;  // what is left of `rest` is buried
}

TriangleMesh BareSurface(const std::vector<Primitive>& parts) {
  std::vector<Polyhedron> solids;
  for (const Primitive& part : parts) solids.push_back(Facets(part));
  TriangleMesh surface;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    std::vector<Polygon> bare = solids[i].faces;
    for (std::size_t j = 0; j < solids.size(); ++j) {
      if (j == i) continue;
      std::vector<Polygon> outside;
      for (const Polygon& polygon : bare) {
        for (Polygon& piece : OutsideOf(polygon, solids[j])) outside.push_back(std::move(piece));
      }
      bare = std::move(outside);
    }
    for (const Polygon& polygon : bare) {
      const auto first = static_cast<std::int32_t>(surface.vertices.size());
      surface.vertices.insert(surface.vertices.end(), polygon.begin(), polygon.end());
      for (std::int32_t k = 2; k < static_cast<std::int32_t>(polygon.size()); ++k) {
        surface.faces.push_back({first, first + k - 1, first + k});
      }
    }
  }
  return surface;
}

}  // namespace

double SignedDistance(const Primitive& primitive, const Vector3d& point) {
  const Vector3d local = ToLocal(primitive, point);
  Vector3d q = local.cwiseAbs() - primitive.half;
  if (primitive.shape == Primitive::Shape::kCylinder) {
    q.x() = local.head<2>().norm() - primitive.half.x();
    q.y() = q.x();
    if (q.x() > 0.0) q.y() = 0.0;  // one direction, not two
  }
  return -(q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0));
}

Vector3d NearestFromInside(const Primitive& primitive, const Vector3d& point) {
  Vector3d local = ToLocal(primitive, point);
  const Vector3d& half = primitive.half;
  const auto push = [&](int axis) { local[axis] = std::copysign(half[axis], local[axis]); };
  const Vector3d q = local.cwiseAbs() - half;
  if (primitive.shape == Primitive::Shape::kBox) {
    int axis = 0;
    q.maxCoeff(&axis);
    push(axis);
  } else if (const double radius = local.head<2>().norm(); q.z() >= radius - half.x()) {
    push(2);
  } else if (radius > 0.0) {
    local.head<2>() *= half.x() / radius;
  } else {
    local.x() = half.x();  // on the axis every direction is as good
  }
  return primitive.center + primitive.axes * local;
}

BoundingBox Bounds(const Primitive& primitive) {
  Vector3d reach = primitive.axes.cwiseAbs() * primitive.half;
  if (primitive.shape == Primitive::Shape::kCylinder) {
    const Vector3d axis = primitive.axes.col(2).cwiseAbs();
    const Eigen::Array3d across = (1.0 - axis.array().square()).max(0.0).sqrt();
    reach = primitive.half.z() * axis + primitive.half.x() * across.matrix();
  }
  return {primitive.center - reach, primitive.center + reach};
}

GraftedSolid::GraftedSolid(std::vector<Primitive> parts) : parts_(std::move(parts)) {
  AG_CHECK(!parts_.empty(), "a solid without parts");
  bare_surface_.emplace(BareSurface(parts_));
}

double GraftedSolid::SignedDistance(const Vector3d& point) const {
  double deepest = -std::numeric_limits<double>::infinity();
  std::size_t owner = 0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double distance = antigrasp::SignedDistance(parts_[i], point);
    if (distance > deepest) {
      deepest = distance;
      owner = i;
    }
  }
  if (deepest <= 0.0) return deepest;
  const Vector3d nearest = NearestFromInside(parts_[owner], point);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (i != owner && antigrasp::SignedDistance(parts_[i], nearest) > 0.0) {
      return std::max(deepest, bare_surface_->Unsigned(point));
    }
  }
  return deepest;
}

BoundingBox GraftedSolid::Bounds() const {
  BoundingBox box = antigrasp::Bounds(parts_[0]);
  for (const Primitive& part : parts_) {
    const BoundingBox other = antigrasp::Bounds(part);
    box.min = box.min.cwiseMin(other.min);
    box.max = box.max.cwiseMax(other.max);
  }
  return box;
}

}  // namespace antigrasp
