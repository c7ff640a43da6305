#include "antigrasp/quality/antipodal_sampler.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/quality/jaw_closing.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A jaw has reached the sampled point when it stops this near to it, as a share of the opening:
// above the ray tree's float rounding, below any feature of a mesh.
constexpr double kSamePoint = 1e-5;

}  // namespace

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
  const Ray back{first.point + jaw_opening_ * axis, -axis, jaw_opening_ * (1.0 - kSamePoint)};
  // What both jaws can run along when the contacts are on this line within the opening.
  const Ray line{back.origin, -axis, 1.5 * jaw_opening_};
  thread_local NearFaces near;
  scene_.Near({&line, 1}, &near);
  const auto opposite = scene_.Closest(back, near);
  if (!opposite || !opposite->front) return reject(GraspRejection::kNoOpposite);

  Grasp grasp;
  grasp.axis = axis;
  grasp.width = (opposite->point - first.point).norm();
  grasp.center = 0.5 * (first.point + opposite->point);
  const auto contacts = CloseJaws(scene_, near, grasp.center, axis, jaw_opening_, friction_);
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
