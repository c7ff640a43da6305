#include "antigrasp/quality/table_reach.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A box that stands on the table as it is modelled.
struct Standing {
  TriangleMesh mesh;
  RayScene scene;
  StablePose pose;
  MetricOptions metric;
  TableOptions table;

  explicit Standing(const Vector3d& extents) : mesh(shapes::Box(extents)), scene(mesh) {
    pose.com_height = 0.5 * extents.z();
  }
  std::optional<Vector3d> Approach(const Grasp& grasp) const {
    return TableReach(mesh, scene, metric, table).Approach(grasp, pose);
  }
};

Grasp Along(const Vector3d& axis, const Vector3d& center) {
  Grasp grasp;
  grasp.axis = axis.normalized();
  grasp.center = center;
  return grasp;
}

Vector3d Tilted(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::cos(angle), 0.0, std::sin(angle)};
}

TEST(TableReach, ComesStraightDownToAGraspAcrossTheMiddle) {
  const Standing box({0.03, 0.03, 0.04});
  const auto approach = box.Approach(Along(Vector3d::UnitX(), Vector3d::Zero()));
  ASSERT_TRUE(approach.has_value());
  EXPECT_NEAR((*approach - Vector3d(0, 0, -1)).norm(), 0.0, 1e-12);
}

TEST(TableReach, DoesNotReachUnderTheObject) {
  const Standing box({0.03, 0.03, 0.04});
  EXPECT_FALSE(box.Approach(Along(Vector3d::UnitZ(), Vector3d::Zero())).has_value());
}

TEST(TableReach, KeepsTheFingertipsAboveTheTable) {
  Standing box({0.03, 0.03, 0.04});
  box.metric.gripper.approach_angles = 1;  // the steepest alone
  // The fingertips are 10 mm below the grasp's centre.
  EXPECT_TRUE(box.Approach(Along(Vector3d::UnitX(), {0, 0, -0.0099})).has_value());
  EXPECT_FALSE(box.Approach(Along(Vector3d::UnitX(), {0, 0, -0.0101})).has_value());
  box.table.clearance = 0.003;
  EXPECT_TRUE(box.Approach(Along(Vector3d::UnitX(), {0, 0, -0.0069})).has_value());
  EXPECT_FALSE(box.Approach(Along(Vector3d::UnitX(), {0, 0, -0.0071})).has_value());
}

TEST(TableReach, LeavesOutWaysInThatAreTooFlat) {
  Standing tall({0.02, 0.02, 0.2});
  tall.metric.gripper.approach_distance = 0.05;
  tall.metric.gripper.approach_angles = 1;
  for (const double cone : {20.0, 40.0}) {
    tall.table.approach_cone = cone;
    const Grasp within = Along(Tilted(cone - 0.1), Vector3d(0, 0, 0.09));
    const Grasp beyond = Along(Tilted(cone + 0.1), Vector3d(0, 0, 0.09));
    EXPECT_TRUE(tall.Approach(within).has_value()) << cone;
    EXPECT_FALSE(tall.Approach(beyond).has_value()) << cone;
  }
}

TEST(TableReach, TurnsAsideWhereTheSteepestWayIsBlocked) {
  // Across the middle of a wall: from above the palm would meet its top, from the side it does not.
  Standing wall({0.03, 0.03, 0.2});
  const Grasp grasp = Along(Vector3d::UnitX(), {0, 0, 0.02});
  EXPECT_FALSE(wall.Approach(grasp).has_value());
  wall.table.approach_cone = 90.0;
  const auto approach = wall.Approach(grasp);
  ASSERT_TRUE(approach.has_value());
  EXPECT_NEAR(approach->dot(grasp.axis), 0.0, 1e-12);
  EXPECT_GT(std::abs(approach->y()), 0.5);
}

TEST(TableReach, KeepsTheWholeWayInAboveTheTable) {
  // A lid 5 cm above the grasp leaves the way from below alone: the gripper then ends 46 + 84 mm
  // below the grasp and comes from 100 mm further down.
  const TriangleMesh mesh =
      shapes::Joined(shapes::Box({0.03, 0.03, 0.04}),
                     Transformed(shapes::Box({0.2, 0.2, 1e-9}), 1.0, {0, 0, 0.05}));
  const RayScene scene(mesh);
  MetricOptions metric;
  metric.gripper.approach_angles = 2;
  const TableReach reach(mesh, scene, metric, {180.0, 0.0});
  const Grasp grasp = Along(Vector3d::UnitX(), Vector3d::Zero());
  for (const double height : {0.129, 0.131, 0.229, 0.231}) {
    const auto approach = reach.Approach(grasp, {Eigen::Matrix3d::Identity(), 1.0, height});
    EXPECT_EQ(approach.has_value(), height > 0.23) << height;
    if (approach) {
      EXPECT_NEAR(approach->z(), 1.0, 1e-12);
    }
  }
}

TEST(TableReach, TakesTheTableFromThePose) {
  Standing box({0.03, 0.03, 0.04});
  // Upside down and on its side.
  box.pose.table_from_object << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  auto approach = box.Approach(Along(Vector3d::UnitX(), Vector3d::Zero()));
  ASSERT_TRUE(approach.has_value());
  EXPECT_NEAR(approach->z(), 1.0, 1e-12);
  box.pose.table_from_object << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  box.pose.com_height = 0.015;
  EXPECT_FALSE(box.Approach(Along(Vector3d::UnitX(), Vector3d::Zero())).has_value());
  approach = box.Approach(Along(Vector3d::UnitY(), Vector3d::Zero()));
  ASSERT_TRUE(approach.has_value());
  EXPECT_NEAR(approach->x(), -1.0, 1e-12);
}

TEST(TableReach, StandsAtTheHeightOfTheCentreOfMass) {
  // A tetrahedron of 2 cm on the face z = 0: its centre of mass is 5 mm up, its box's centre 10 mm.
  // The fingertips are 10 mm below the grasp, which leaves 0.1 mm above the table or below it.
  const TriangleMesh mesh = Transformed(shapes::Tetrahedron(), 0.02, Vector3d::Zero());
  const RayScene scene(mesh);
  StablePose pose;
  pose.com_height = 0.005;
  MetricOptions metric;
  metric.gripper.approach_angles = 1;
  const TableReach reach(mesh, scene, metric, {});
  EXPECT_TRUE(reach.Approach(Along(Vector3d::UnitX(), {0.005, 0.005, 0.0101}), pose));
  EXPECT_FALSE(reach.Approach(Along(Vector3d::UnitX(), {0.005, 0.005, 0.0099}), pose));
}

TEST(TableReach, TurnsTowardsWayInCrossAxisFirst) {
  // As above, from the side: 90 degrees from straight down in steps of 22.5, -z cross x = -y.
  Standing wall({0.03, 0.03, 0.2});
  wall.table.approach_cone = 90.0;
  const auto approach = wall.Approach(Along(Vector3d::UnitX(), {0, 0, 0.02}));
  ASSERT_TRUE(approach.has_value());
  EXPECT_LT(approach->y(), -0.5);
  const auto turned = wall.Approach(Along(-Vector3d::UnitX(), {0, 0, 0.02}));
  ASSERT_TRUE(turned.has_value());
  EXPECT_NEAR((*turned - Vector3d(0.0, -approach->y(), approach->z())).norm(), 0.0, 1e-12);
}

TEST(TableReach, OpensTheGripperAsWideAsTheMetricSays) {
  Standing box({0.045, 0.03, 0.04});
  const Grasp grasp = Along(Vector3d::UnitX(), Vector3d::Zero());
  EXPECT_TRUE(box.Approach(grasp).has_value());
  box.metric.jaw_opening = 0.044;
  EXPECT_FALSE(box.Approach(grasp).has_value());
  // The way in begins 0.1 m further out, where a narrow lid 0.15 m above may stand in it.
  box.metric.jaw_opening = 0.05;
  box.metric.gripper.approach_angles = 1;
  const TriangleMesh with_lid =
      shapes::Joined(box.mesh, Transformed(shapes::Box({0.2, 0.2, 1e-9}), 1.0, {0, 0, 0.15}));
  const RayScene scene(with_lid);
  const StablePose pose{Eigen::Matrix3d::Identity(), 1.0, 0.02};
  EXPECT_FALSE(TableReach(with_lid, scene, box.metric, {}).Approach(grasp, pose));
  box.metric.gripper.approach_distance = 0.01;
  EXPECT_TRUE(TableReach(with_lid, scene, box.metric, {}).Approach(grasp, pose));
}

TEST(TableReach, LooksAtTheConeAloneWithoutAGripper) {
  Standing box({0.03, 0.03, 0.04});
  box.metric.collision = Collision::kJaws;
  EXPECT_TRUE(box.Approach(Along(Vector3d::UnitX(), {0, 0, -0.019})).has_value());
  EXPECT_FALSE(box.Approach(Along(Tilted(46), Vector3d::Zero())).has_value());
}

}  // namespace
}  // namespace antigrasp
