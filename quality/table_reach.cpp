#include "antigrasp/quality/table_reach.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/quality/reachability.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A grasp axis nearer to the table's normal than this share of a unit vector has no steepest way
// in.
constexpr double kNoWayIn = 1e-9;

// Signed distance of the lowest corner of the boxes above the plane up . x = 0; `center` is where
// the gripper frame has its origin.
double LowestCorner(const std::array<BoundingBox, 3>& boxes, const Eigen::Matrix3d& from_gripper,
                    const Vector3d& center, const Vector3d& up) {
  const Vector3d slope = from_gripper.transpose() * up;
  double lowest = std::numeric_limits<double>::infinity();
  for (const BoundingBox& box : boxes) {
    const double height = box.Center().dot(slope) - 0.5 * box.Extent().dot(slope.cwiseAbs());
    lowest = std::min(lowest, height);
  }
  return up.dot(center) + lowest;
}

}  // namespace

struct TableReach::Impl {
  Vector3d com;
  GripperModel gripper;
  double opening;
  TableOptions table;
  std::array<BoundingBox, 3> boxes;
  std::optional<GripperCollision> collision;

  // The plane of the table is up . x = level.
  // Height of the table along `up`.
  double Level(const Vector3d& up, const StablePose& pose) const {
    return up.dot(com) - pose.com_height;
  }
  bool IsSteep(const Vector3d& approach, const Vector3d& up) const {
    const double least_cosine = std::cos(table.approach_cone * std::numbers::pi / 180.0);
    return -approach.dot(up) >= least_cosine - kNoWayIn;
  }
  bool IsFree(const Grasp& grasp, const Vector3d& approach, const Vector3d& up,
              double level) const {
    if (!collision) return true;
    Eigen::Matrix3d from_gripper;
    from_gripper << approach, grasp.axis, approach.cross(grasp.axis);
    const double lowest = LowestCorner(boxes, from_gripper, grasp.center, up);
    return lowest >= level + table.clearance && collision->IsFree(grasp, opening, approach);
  }
};

TableReach::TableReach(const TriangleMesh& mesh, const RayScene& scene, const MetricOptions& metric,
                       const TableOptions& table) {
  auto impl = std::make_unique<Impl>();
  impl->com = CenterOfMass(mesh);
  impl->gripper = metric.gripper;
  impl->opening = metric.jaw_opening;
  impl->table = table;
  impl->boxes = GripperBoxes(metric.gripper, metric.jaw_opening, metric.gripper.approach_distance);
  if (metric.collision == Collision::kGripper) impl->collision.emplace(mesh, scene, metric.gripper);
  impl_ = std::move(impl);
}
TableReach::~TableReach() = default;
TableReach::TableReach(TableReach&&) noexcept = default;
TableReach& TableReach::operator=(TableReach&&) noexcept = default;

std::optional<Vector3d> TableReach::Approach(const Grasp& grasp, const StablePose& pose) const {
  const Vector3d up = pose.table_from_object.row(2);
  const double level = impl_->Level(up, pose);
  const Vector3d across = up.dot(grasp.axis) * grasp.axis - up;
  if (across.norm() < kNoWayIn) return std::nullopt;
  const Vector3d steepest = across.normalized();
  const Vector3d aside = steepest.cross(grasp.axis);
  for (int i = 0; i < impl_->gripper.approach_angles; ++i) {
    const int step = i % 2 == 1 ? (i + 1) / 2 : -i / 2;
    const double angle = 2.0 * std::numbers::pi * step / impl_->gripper.approach_angles;
    const Vector3d approach = std::cos(angle) * steepest + std::sin(angle) * aside;
    if (!impl_->IsSteep(approach, up)) break;  // the next ones are flatter still
    if (impl_->IsFree(grasp, approach, up, level)) return approach;
  }
  return std::nullopt;
}

bool TableReach::Reaches(const Grasp& grasp, const StablePose& pose) const {
  const Vector3d up = pose.table_from_object.row(2);
  return impl_->IsSteep(grasp.approach, up) &&
         impl_->IsFree(grasp, grasp.approach, up, impl_->Level(up, pose));
}

}  // namespace antigrasp
