#include "antigrasp/quality/reachability.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "antigrasp/contact/box_triangle.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

// Shorter than this (metres or a share of a unit vector), a direction is rounding.
constexpr double kNoDirection = 1e-6;

constexpr std::int64_t kNone = -1;

Triangle Corners(const TriangleMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  return {mesh.vertices[static_cast<std::size_t>(a)], mesh.vertices[static_cast<std::size_t>(b)],
          mesh.vertices[static_cast<std::size_t>(c)]};
}

bool Meets(const OrientedBox& box, const TriangleMesh& mesh, std::size_t face) {
  const Triangle triangle = Corners(mesh, face);
  const auto box_from_object = box.axes.transpose();
  return BoxMeetsTriangle(box.half, {box_from_object * (triangle[0] - box.center),
                                     box_from_object * (triangle[1] - box.center),
                                     box_from_object * (triangle[2] - box.center)});
}

Vector3d Across(const Vector3d& v, const Vector3d& axis) { return v - v.dot(axis) * axis; }

// The approach at angle 0; see the header. A centre of mass on the grasp's line gives no direction:
// then the contacts' normals, which move with the object too; then anything.
Vector3d FirstApproach(const Grasp& grasp, const Vector3d& com) {
  for (const Vector3d& towards :
       {Vector3d(com - grasp.center), grasp.contacts[0].normal, grasp.contacts[1].normal}) {
    const Vector3d across = Across(towards, grasp.axis);
    if (across.norm() > kNoDirection && across.allFinite()) return across.normalized();
  }
  return grasp.axis.unitOrthogonal();
}

}  // namespace

struct GripperCollision::Impl {
  const TriangleMesh& mesh;
  const RayScene& scene;
  GripperModel model;
  Vector3d com;

  Impl(const TriangleMesh& object, const RayScene& ray_scene, const GripperModel& gripper)
      : mesh(object), scene(ray_scene), model(gripper), com(CenterOfMass(object)) {}

  // A face the box meets, or kNone. `guess` is tried first: what blocks one angle often blocks
  // the next.
  std::int64_t Hit(const OrientedBox& box, std::int64_t guess,
                   std::vector<std::uint32_t>* blocks) const {
    if (guess != kNone && Meets(box, mesh, static_cast<std::size_t>(guess))) return guess;
    blocks->clear();
    scene.Blocks().Near(box, blocks);
    return scene.Blocks().FindIn(box, *blocks,
                                 [&](std::size_t face) { return Meets(box, mesh, face); });
  }

  bool Inside(const Vector3d& point, const Vector3d& direction) const {
    const Ray ray{point, direction, std::numeric_limits<double>::infinity()};
    thread_local NearFaces near;
    scene.Near({&ray, 1}, &near);
    const auto hit = scene.Closest(ray, near);
    return hit && !hit->front;
  }

  // `blocking` carries the face that each box met last from one angle to the next.
  bool IsFree(const Grasp& grasp, const std::array<BoundingBox, 3>& boxes, const Vector3d& approach,
              std::array<std::int64_t, 3>* blocking) const {
    Matrix3d object_from_gripper;
    object_from_gripper << approach, grasp.axis, approach.cross(grasp.axis);
    std::array<Vector3d, 3> centers;
    std::vector<std::uint32_t> near;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      centers[i] = grasp.center + object_from_gripper * boxes[i].Center();
      const std::int64_t hit =
          Hit({object_from_gripper, centers[i], 0.5 * boxes[i].Extent()}, (*blocking)[i], &near);
      if (hit != kNone) {
        (*blocking)[i] = hit;
        return false;
      }
    }
    // No box touches the surface, so that one point of each says where the box is.
    for (const Vector3d& center : centers) {
      if (Inside(center, -approach)) return false;
    }
    return true;
  }
};

GripperCollision::GripperCollision(const TriangleMesh& mesh, const RayScene& scene,
                                   const GripperModel& model)
    : impl_(std::make_unique<const Impl>(mesh, scene, model)) {}
GripperCollision::~GripperCollision() = default;
GripperCollision::GripperCollision(GripperCollision&&) noexcept = default;
GripperCollision& GripperCollision::operator=(GripperCollision&&) noexcept = default;

std::optional<Vector3d> GripperCollision::FreeApproach(const Grasp& grasp, double opening) const {
  const auto boxes = GripperBoxes(impl_->model, opening, impl_->model.approach_distance);
  const Vector3d ahead = FirstApproach(grasp, impl_->com);
  const Vector3d aside = ahead.cross(grasp.axis);
  std::array<std::int64_t, 3> blocking{kNone, kNone, kNone};
  for (int i = 0; i < impl_->model.approach_angles; ++i) {
    const int step = i % 2 == 1 ? (i + 1) / 2 : -i / 2;
    const double angle = 2.0 * std::numbers::pi * step / impl_->model.approach_angles;
    const Vector3d approach = std::cos(angle) * ahead + std::sin(angle) * aside;
    if (impl_->IsFree(grasp, boxes, approach, &blocking)) return approach;
  }
  return std::nullopt;
}

bool GripperCollision::IsFree(const Grasp& grasp, double opening, const Vector3d& approach) const {
  const auto boxes = GripperBoxes(impl_->model, opening, impl_->model.approach_distance);
  std::array<std::int64_t, 3> blocking{kNone, kNone, kNone};
  return impl_->IsFree(grasp, boxes, approach, &blocking);
}

}  // namespace antigrasp
