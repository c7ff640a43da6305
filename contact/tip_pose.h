#pragma once

#include <Eigen/Core>

namespace antigrasp {

// Where a fingertip is, in the object's frame, metres.
struct SpherePose {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

// A box whose front face is what touches.
struct PadPose {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  // Columns are the box's axes; column 0 points out of the front face, towards the object.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  // half sizes along the columns

  Eigen::Vector3d Front() const { return center + half[0] * axes.col(0); }  // its middle
};

// One point where a tip meets a surface.
struct SurfaceContact {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // midway between the two surfaces
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    // unit, out of the object, towards the tip
  double distance = 0.0;                               // below 0: as deep do they penetrate
};

}  // namespace antigrasp
