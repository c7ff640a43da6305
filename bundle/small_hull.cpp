#include "antigrasp/bundle/small_hull.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kFlat = 1e-7;  // of the size: no further out is in a face

template <typename Measure>
int Furthest(const std::vector<Vector3d>& points, const Measure& measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (measure(points[i]) > measure(points[best])) best = i;
  }
  return static_cast<int>(best);
}

}  // namespace

SmallHull::SmallHull(std::vector<Vector3d> points) : points_(std::move(points)) {
  if (points_.size() < 4 || !Begin()) return;
  for (std::size_t p = 0; p < points_.size(); ++p) Add(static_cast<int>(p));
}

double SmallHull::Volume() const {
  double sum = 0.0;
  for (const Face& face : faces_) {
    const Vector3d& origin = points_[0];
    sum += (At(face.a) - origin).dot((At(face.b) - origin).cross(At(face.c) - origin));
  }
  return sum / 6.0;
}

ConvexPart SmallHull::Part() const {
  ConvexPart part;
  if (faces_.empty()) return part;
  for (const Face& face : faces_) {
    if (face.normal.squaredNorm() > 0.5) {
      part.planes.push_back({face.normal, face.normal.dot(At(face.a))});
    }
  }
  part.box = {points_[0], points_[0]};
  for (const Vector3d& point : points_) {
    part.box.min = part.box.min.cwiseMin(point);
    part.box.max = part.box.max.cwiseMax(point);
  }
  part.volume = Volume();
  return part;
}

SmallHull::Face SmallHull::Make(int a, int b, int c) const {
  const Vector3d cross = (At(b) - At(a)).cross(At(c) - At(a));
  const double length = cross.norm();
  const Vector3d normal = length > 0.0 ? Vector3d(cross / length) : Vector3d::Zero();
  return {a, b, c, normal, normal.dot(At(a)) + near_};
}

// A tetrahedron; false when the points lie in a plane.
bool SmallHull::Begin() {
  const int a = Furthest(points_, [](const Vector3d& p) { return p.x(); });
  const int b = Furthest(points_, [&](const Vector3d& p) { return (p - At(a)).squaredNorm(); });
  const Vector3d along = At(b) - At(a);
  near_ = kFlat * along.norm();
  const int c =
      Furthest(points_, [&](const Vector3d& p) { return along.cross(p - At(a)).squaredNorm(); });
  const Vector3d normal = along.cross(At(c) - At(a)).normalized();
  const int d =
      Furthest(points_, [&](const Vector3d& p) { return std::abs(normal.dot(p - At(a))); });
  const double height = normal.dot(At(d) - At(a));
  if (!(std::abs(height) > near_)) return false;
  const int second = height > 0.0 ? c : b, third = height > 0.0 ? b : c;
  faces_ = {Make(a, second, third), Make(a, d, second), Make(second, d, third), Make(third, d, a)};
  return true;
}

// In place of the faces that see the point a fan from it to their border.
void SmallHull::Add(int p) {
  edges_.clear();
  std::size_t kept = 0;
  for (const Face& face : faces_) {
    if (face.normal.dot(At(p)) > face.offset) {
      edges_.insert(edges_.end(), {{face.a, face.b}, {face.b, face.c}, {face.c, face.a}});
    } else {
      faces_[kept++] = face;
    }
  }
  if (kept == faces_.size()) return;
  faces_.resize(kept);
  for (const auto& [from, to] : edges_) {
    if (std::find(edges_.begin(), edges_.end(), std::pair(to, from)) == edges_.end()) {
      faces_.push_back(Make(from, to, p));
    }
  }
}

}  // namespace antigrasp
