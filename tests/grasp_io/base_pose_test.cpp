// From a grasp to the pose of a gripper's base and back, on poses known on paper.
#include "antigrasp/grasp_io/base_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "antigrasp/core/error.h"
#include "antigrasp/grasp_io/grasp_hdf5.h"
#include "antigrasp/quality/named_gripper.h"

namespace antigrasp {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

const Vector3d kX = Vector3d::UnitX(), kY = Vector3d::UnitY(), kZ = Vector3d::UnitZ();

MetricOptions MetricOf(const std::string& gripper) {
  MetricOptions metric;
  ApplyGripper(gripper, &metric);
  return metric;
}

// Down onto the middle of a cube at the origin, jaws along x.
PosedGrasp AcrossACube() { return {"0", Vector3d::Zero(), kX, -kZ}; }

// The Franka hand's tool centre is 103.4 mm from its flange.
TEST(BasePose, OfAPandaAboveACubeIsTheOneOnPaper) {
  Matrix4d convention, link;
  convention << 1, 0, 0, 0,  //
      0, -1, 0, 0,           //
      0, 0, -1, 0.1034,      //
      0, 0, 0, 1;
  link << 0, 1, 0, 0,    //
      1, 0, 0, 0,        //
      0, 0, -1, 0.1034,  //
      0, 0, 0, 1;
  const MetricOptions metric = MetricOf("panda");
  EXPECT_TRUE(BasePose(AcrossACube(), ConventionFrame(metric)).isApprox(convention, 1e-15));
  EXPECT_TRUE(BasePose(AcrossACube(), LinkFrame(BaseOf("panda"), metric)).isApprox(link, 1e-15));
}

TEST(BasePose, OfEveryKnownGripperLeadsBackToTheGraspBitForBit) {
  const Vector3d axis = Vector3d(0.6, 0.0, 0.8), approach = Vector3d(-0.8, 0.0, 0.6);
  for (const NamedGripper& gripper : NamedGrippers()) {
    const std::string name(gripper.name);
    const MetricOptions metric = MetricOf(name);
    for (const BaseFrame& frame : {ConventionFrame(metric), LinkFrame(BaseOf(name), metric)}) {
      const Matrix4d pose = BasePose({"0", {0.1, -0.2, 0.3}, axis, approach}, frame);
      EXPECT_NEAR(pose.topLeftCorner(3, 3).determinant(), 1.0, 1e-15);
      GivenGrasp grasp;
      TakeBasePose(pose, frame, &grasp);
      EXPECT_EQ(grasp.axis, axis) << name;
      EXPECT_EQ(grasp.approach, approach) << name;
      EXPECT_NEAR((grasp.center - Vector3d(0.1, -0.2, 0.3)).norm(), 0.0, 1e-16) << name;
    }
  }
}

TEST(BasePose, FollowsTheAxesOfAnyLink) {
  GripperBase base;
  base.approach = LinkAxis::kMinusX;
  base.closing = LinkAxis::kZ;
  const Matrix4d pose = BasePose(AcrossACube(), LinkFrame(base, MetricOf("yumi")));
  EXPECT_EQ(Vector3d(pose.topLeftCorner(3, 3) * -kX), Vector3d(-kZ));
  EXPECT_EQ(Vector3d(pose.topLeftCorner(3, 3) * kZ), kX);
  EXPECT_EQ(Vector3d(pose.topLeftCorner(3, 3) * kY), Vector3d(kX.cross(kZ)));
}

TEST(BasePose, OfWhatIsNoRotationIsNoPose) {
  const BaseFrame frame = ConventionFrame(MetricOf("yumi"));
  Matrix4d mirrored = Matrix4d::Identity(), scaled = 2.0 * Matrix4d::Identity(), nan = scaled;
  mirrored(0, 0) = -1.0;
  nan(1, 1) = std::nan("");
  for (const Matrix4d& pose : {mirrored, scaled, nan, PoseOf(kX, 0.0, Vector3d::Zero())}) {
    GivenGrasp grasp;
    TakeBasePose(pose, frame, &grasp);
    EXPECT_FALSE(grasp.center.allFinite());
  }
  GivenGrasp grasp;  // of single precision
  TakeBasePose(Matrix4d::Identity().cast<float>().cast<double>() * 1.0001, frame, &grasp);
  EXPECT_TRUE(grasp.center.allFinite());
}

// grasping/grasp.py: at angle 0 a jaw along x comes from (0, -1, 0); z is that cross x = (0, 0, 1).
TEST(DexNetAngle, OfAWayDownOntoJawsAlongXIsAQuarterTurnBack) {
  EXPECT_NEAR(DexNetAngle(kX, -kZ), -0.5 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(DexNetAngle(kX, -kY), 0.0, 1e-15);
  EXPECT_NEAR(DexNetAngle(kZ, kX), 0.0, 1e-15);
  for (const Vector3d& axis : {kX, kZ, Vector3d(0.48, -0.6, 0.64)}) {
    const Vector3d approach = axis.unitOrthogonal();
    EXPECT_NEAR((DexNetApproach(axis, DexNetAngle(axis, approach)) - approach).norm(), 0.0, 1e-15);
  }
}

TEST(RequireSameGripper, RefusesAnotherKnownOneAndTakesNamesThatNobodyKnows) {
  const GripperBase panda = BaseOf("panda");
  for (const char* name : {"panda", "franka_panda", "", "our_new_hand"}) {
    EXPECT_NO_THROW(RequireSameGripper(name, panda, "g.h5")) << name;
  }
  try {
    RequireSameGripper("robotiq_2f_85", panda, "g.h5");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "grasps of the gripper robotiq_2f_85, scored with panda (g.h5): expected "
                 "--gripper robotiq_85");
  }
}

TEST(GraspLabel, IsTheTrialsWhereAGraspWasExecutedAndElseTheQualitys) {
  GraspFileAbout about;
  PosedGrasp grasp;
  grasp.quality = 0.002;
  EXPECT_TRUE(about.Success(grasp));
  EXPECT_EQ(about.LabelText(), "robust quality of at least 0.002");
  about.success_quality = 0.003;
  EXPECT_FALSE(about.Success(grasp));
  about.protocol = "six-ways";
  EXPECT_EQ(about.LabelText(),
            "held in at least half of the executions of the trial six-ways; of a grasp that was "
            "not executed: robust quality of at least 0.003");
  EXPECT_FALSE(about.Success(grasp));
  grasp.executions = 5;
  grasp.held = 2;
  grasp.quality = 1.0;
  EXPECT_FALSE(about.Success(grasp));
  grasp.held = 3;
  EXPECT_TRUE(about.Success(grasp));
  grasp.executions = 6;
  EXPECT_TRUE(about.Success(grasp));
}

}  // namespace
}  // namespace antigrasp
