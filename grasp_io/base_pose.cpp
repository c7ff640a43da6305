#include "antigrasp/grasp_io/base_pose.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/quality/named_gripper.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

int Column(LinkAxis axis) { return static_cast<int>(axis) % 3; }
double Sign(LinkAxis axis) { return static_cast<int>(axis) < 3 ? 1.0 : -1.0; }

}  // namespace

bool GraspFileAbout::Success(const PosedGrasp& grasp) const {
  if (grasp.executions > 0) return 2 * grasp.held >= grasp.executions;
  return grasp.quality >= success_quality;
}

std::string GraspFileAbout::LabelText() const {
  const std::string quality = "robust quality of at least " + FormatDouble(success_quality);
  if (protocol.empty()) return quality;
  return "held in at least half of the executions of the trial " + protocol +
         "; of a grasp that was not executed: " + quality;
}

BaseFrame LinkFrame(const GripperBase& base, const MetricOptions& metric) {
  return {base.approach, base.closing, ConventionFrame(metric).depth};
}

BaseFrame ConventionFrame(const MetricOptions& metric) {
  return {LinkAxis::kZ, LinkAxis::kX, metric.gripper.palm_distance + metric.gripper.palm_depth};
}

Matrix4d BasePose(const PosedGrasp& grasp, const BaseFrame& frame) {
  Matrix3d turn;
  turn.col(Column(frame.approach)) = Sign(frame.approach) * grasp.approach;
  turn.col(Column(frame.closing)) = Sign(frame.closing) * grasp.axis;
  const int third = 3 - Column(frame.approach) - Column(frame.closing);
  turn.col(third) = turn.col((third + 1) % 3).cross(turn.col((third + 2) % 3));
  Matrix4d pose = Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = turn;
  pose.topRightCorner<3, 1>() = grasp.center - frame.depth * grasp.approach;
  return pose;
}

void TakeBasePose(const Matrix4d& object_from_base, const BaseFrame& frame, GivenGrasp* grasp) {
  constexpr double kRigid = 1e-3;
  const Matrix3d turn = object_from_base.topLeftCorner<3, 3>();
  const bool rigid =
      (turn.transpose() * turn - Matrix3d::Identity()).cwiseAbs().maxCoeff() < kRigid &&
      turn.determinant() > 0.0;
  grasp->frame = GraspFrame::kMetres;
  grasp->axis = Sign(frame.closing) * turn.col(Column(frame.closing));
  grasp->approach = Sign(frame.approach) * turn.col(Column(frame.approach));
  grasp->center = object_from_base.topRightCorner<3, 1>() + frame.depth * grasp->approach;
  if (!rigid) grasp->center.setConstant(std::numeric_limits<double>::quiet_NaN());
}

Matrix4d PoseOf(const Vector3d& position, double w, const Vector3d& xyz) {
  Matrix4d pose = Matrix4d::Identity();
  Eigen::Quaterniond turn(w, xyz.x(), xyz.y(), xyz.z());
  turn.coeffs() /= turn.norm();  // normalized() leaves 0 as it is, and that turns by nothing
  pose.topLeftCorner<3, 3>() = turn.toRotationMatrix();
  pose.topRightCorner<3, 1>() = position;
  return pose;
}

void RequireSameGripper(const std::string& name, const GripperBase& base, const std::string& path) {
  if (name.empty() || name == base.name || name == base.Asset()) return;
  for (const NamedGripper& known : NamedGrippers()) {
    if (name != known.name && name != known.asset) continue;
    throw InputError("grasps of the gripper " + name + ", scored with " + base.name, path,
                     "--gripper " + std::string(known.name));
  }
}

}  // namespace antigrasp
