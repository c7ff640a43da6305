#include "antigrasp/quality/gripper.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(GripperBoxes, StandAsTheHeaderSays) {
  const GripperModel model;
  const auto [finger1, finger2, palm] = GripperBoxes(model, 0.05, 0.0);
  EXPECT_NEAR((finger1.min - Vector3d(-0.046, -0.035, -0.01)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((finger1.max - Vector3d(0.01, -0.025, 0.01)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((finger2.min - Vector3d(-0.046, 0.025, -0.01)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((finger2.max - Vector3d(0.01, 0.035, 0.01)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((palm.min - Vector3d(-0.13, -0.04, -0.025)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((palm.max - Vector3d(-0.046, 0.04, 0.025)).norm(), 0.0, 1e-15);
}

TEST(GripperBoxes, SweepBackwardsOnly) {
  const GripperModel model;
  const auto still = GripperBoxes(model, 0.03, 0.0);
  const auto swept = GripperBoxes(model, 0.03, 0.2);
  for (std::size_t i = 0; i < still.size(); ++i) {
    EXPECT_EQ(swept[i].max, still[i].max);
    EXPECT_NEAR((swept[i].min + 0.2 * Vector3d::UnitX() - still[i].min).norm(), 0.0, 1e-15);
  }
}

TEST(GripperModel, PalmCarriesTheFingersAtFullOpening) {
  const GripperModel model;
  EXPECT_GE(model.palm_length, 0.05 + 2.0 * model.finger_thickness);
  EXPECT_GE(model.palm_width, model.finger_width);
}

}  // namespace
}  // namespace antigrasp
