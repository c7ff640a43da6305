#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "antigrasp/contact/tip_pose.h"
#include "antigrasp/core/choice.h"

namespace antigrasp {

enum class TipShape {
  kSphere,  // a ball, as the paper's bearings
  kPad      // a flat pad: a box whose front face meets the object
};
constexpr auto ChoicesOf(TipShape) {
  return std::to_array<Choice<TipShape>>({{TipShape::kSphere, "sphere"}, {TipShape::kPad, "pad"}});
}

// Metres.
struct Fingertip {
  TipShape shape = TipShape::kSphere;
  double radius = 0.005;        // of a ball
  double pad_width = 0.02;      // across grasp axis and way in
  double pad_height = 0.02;     // along the way in
  double patch_radius = 0.005;  // of a ball's contact: it bears a torque up to 2/3 of this times
                                // friction and force (uniform pressure). A pad has its real patch

  static constexpr double kPadThickness = 0.004;
  double Torsion() const { return 2.0 / 3.0 * patch_radius; }
  // Half sizes: x along the grasp axis, z along the way in.
  Eigen::Vector3d Half() const {
    if (shape == TipShape::kSphere) return Eigen::Vector3d::Constant(radius);
    return 0.5 * Eigen::Vector3d(kPadThickness, pad_width, pad_height);
  }
};

// The pad of tip 1 (side 1) or 2 (side -1) whose centre is at `center` of the gripper's frame, in
// the frame that `to_body` leads to.
inline PadPose PadAt(const Fingertip& tip, const Eigen::Isometry3d& to_body,
                     const Eigen::Vector3d& center, double side) {
  Eigen::Matrix3d axes = to_body.linear();
  axes.leftCols<2>() *= side;  // the front face looks at the other tip
  return {to_body * center, axes, tip.Half()};
}

}  // namespace antigrasp
