#include "antigrasp/quality/antipodal_sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/check.h"
#include "antigrasp/quality/jaw_closing.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A jaw has reached the sampled point when it stops this near to it, as a share of the opening:
// above the ray tree's float rounding, below any feature of a mesh.
constexpr double kSamePoint = 1e-5;

}  // namespace

SurfaceSampler::SurfaceSampler(const TriangleMesh& mesh) : mesh_(mesh) {
  cumulative_.reserve(mesh.faces.size());
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    area += 0.5 * FaceCross(mesh, i).norm();
    cumulative_.push_back(area);
  }
}

SurfaceSampler::Sample SurfaceSampler::Draw(RngStream* rng) const {
  AG_CHECK(area() > 0.0, "sampling needs a surface with area");
  // upper_bound never lands on a face without area: its sum equals its predecessor's.
  const double at = area() * rng->Uniform();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
  const auto face =
      static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
  double a = rng->Uniform();
  double b = rng->Uniform();
  if (a + b > 1.0) {  // fold the parallelogram onto the triangle
    a = 1.0 - a;
    b = 1.0 - b;
  }
  const auto& corners = mesh_.faces[face];
  const Vector3d& p0 = mesh_.vertices[static_cast<std::size_t>(corners[0])];
  const Vector3d& p1 = mesh_.vertices[static_cast<std::size_t>(corners[1])];
  const Vector3d& p2 = mesh_.vertices[static_cast<std::size_t>(corners[2])];
  return {p0 + a * (p1 - p0) + b * (p2 - p0), FaceCross(mesh_, face).normalized()};
}

Vector3d DrawInCone(const Vector3d& axis, double half_angle, RngStream* rng) {
  // Area on the sphere is proportional to height (Archimedes).
  const double height = 1.0 - rng->Uniform() * (1.0 - std::cos(half_angle));
  const double around = 2.0 * std::numbers::pi * rng->Uniform();
  const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
  const Vector3d side = axis.unitOrthogonal();
  const Vector3d up = axis.cross(side);
  return (height * axis + radius * (std::cos(around) * side + std::sin(around) * up)).normalized();
}

AntipodalSampler::AntipodalSampler(const TriangleMesh& mesh, const RayScene& scene, double friction,
                                   double jaw_opening)
    : surface_(mesh), scene_(scene), friction_(friction), jaw_opening_(jaw_opening) {}

std::optional<Grasp> AntipodalSampler::Try(RngStream* rng, GraspRejection* why) const {
  const auto reject = [why](GraspRejection reason) {
    if (why != nullptr) *why = reason;
    return std::nullopt;
  };
  const SurfaceSampler::Sample first = surface_.Draw(rng);
  const Vector3d axis = DrawInCone(-first.normal, std::atan(friction_), rng);
  const auto opposite =
      scene_.Closest(first.point + jaw_opening_ * axis, -axis, jaw_opening_ * (1.0 - kSamePoint));
  if (!opposite || !opposite->front) return reject(GraspRejection::kNoOpposite);

  Grasp grasp;
  grasp.axis = axis;
  grasp.width = (opposite->point - first.point).norm();
  grasp.center = 0.5 * (first.point + opposite->point);
  const auto contacts = CloseJaws(scene_, grasp.center, axis, jaw_opening_, friction_);
  if (!contacts) {
    return reject(Slips(-opposite->normal, -axis, friction_) ? GraspRejection::kSlips
                                                             : GraspRejection::kJawBlocked);
  }
  grasp.contacts = *contacts;
  const double tolerance = kSamePoint * jaw_opening_;
  if ((grasp.contacts[0].point - first.point).norm() > tolerance ||
      (grasp.contacts[1].point - opposite->point).norm() > tolerance) {
    return reject(GraspRejection::kJawBlocked);
  }
  return grasp;
}

}  // namespace antigrasp
