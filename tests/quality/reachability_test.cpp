#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/angles.h"
#include "tests/quality/reached_object.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Along x; the contacts' normals as on a sphere about `center`.
Grasp AlongX(const Vector3d& center, double width) {
  Grasp grasp;
  grasp.center = center;
  grasp.axis = Vector3d::UnitX();
  grasp.width = width;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vector3d normal = (i == 0 ? -1.0 : 1.0) * grasp.axis;
    grasp.contacts[i] = {center + 0.5 * width * normal, normal, 1.0};
  }
  return grasp;
}

TEST(GripperCollision, ASphereOfFourCentimetresIsReachedFromEveryAngle) {
  const ReachedObject sphere(shapes::Sphere(0.02, 4));
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.04);
  for (int i = 0; i < 360; ++i) {
    EXPECT_TRUE(sphere.IsFree(grasp, {0.0, std::cos(i * kDegree), std::sin(i * kDegree)})) << i;
  }
}

TEST(GripperCollision, AWallAtTheBackBlocksOnlyTheWayThroughIt) {
  // A thin wall of 2 m, 120 mm behind the grasp: the gripper (130 mm long) stands in it, and from
  // 140 mm on it has to come through it; past 230 mm the way in begins on this side.
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.04);
  for (const auto& [distance, free] : {std::pair(0.120, false), std::pair(0.140, false),
                                       std::pair(0.229, false), std::pair(0.231, true)}) {
    const ReachedObject object(Moved(shapes::Box({2.0, 2.0, 0.001}), 0.0, 0.0, distance + 0.0005));
    EXPECT_EQ(object.IsFree(grasp, -Vector3d::UnitZ()), free) << distance;
  }
}

TEST(GripperCollision, ABoxOnASlabIsReachedDownToTheAngleWhereThePalmTouches) {
  // The cube's centre is 20 mm above a slab of 2 m. Tilted by a from straight down, the palm's
  // lower edge is 20 + 46 cos a - 25 sin a above the slab: 0 at 83.9 degrees.
  const ReachedObject object(
      shapes::Joined(Moved(shapes::Box({0.04, 0.04, 0.041}), 0.0, 0.0, -0.0005),
                     Moved(shapes::Box({2.0, 2.0, 0.05}), 0.0, 0.0, -0.045)));
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.04);
  for (int degrees = 0; degrees <= 180; ++degrees) {
    for (const double side : {-1.0, 1.0}) {
      const double a = degrees * kDegree;
      EXPECT_EQ(object.IsFree(grasp, {0.0, side * std::sin(a), -std::cos(a)}), degrees <= 83)
          << degrees;
    }
  }
  const auto approach = object.FreeApproach(grasp);
  ASSERT_TRUE(approach);
  EXPECT_LT(approach->z(), -0.1);
  EXPECT_NEAR(approach->x(), 0.0, 1e-15);
  EXPECT_NEAR(approach->norm(), 1.0, 1e-15);
}

// A ball of 2 cm at the bottom of a square shaft with walls 1 cm thick and 10 cm high.
ReachedObject BallInShaft(double shaft) {
  const double wall = 0.01, height = 0.10, outer = shaft + 2.0 * wall;
  const double side = 0.5 * (shaft + wall), middle = 0.5 * height - 0.015;
  TriangleMesh mesh = Moved(shapes::Box({outer, outer, wall}), 0.0, 0.0, -0.015 - 0.5 * wall);
  for (const double s : {-1.0, 1.0}) {
    mesh = shapes::Joined(mesh, Moved(shapes::Box({wall, outer, height}), s * side, 0.0, middle));
    mesh = shapes::Joined(mesh, Moved(shapes::Box({outer, wall, height}), 0.0, s * side, middle));
  }
  return ReachedObject(shapes::Joined(mesh, shapes::Sphere(0.01, 2)));
}

TEST(GripperCollision, ABallInAShaftIsReachedOnlyIfTheGripperFitsInto) {
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.02);
  EXPECT_FALSE(BallInShaft(0.03).FreeApproach(grasp));
  EXPECT_FALSE(BallInShaft(0.069).FreeApproach(grasp));  // the fingers are 70 mm apart outside
  EXPECT_FALSE(BallInShaft(0.079).FreeApproach(grasp));  // the palm is 80 mm long
  const auto approach = BallInShaft(0.081).FreeApproach(grasp);
  ASSERT_TRUE(approach);
  EXPECT_NEAR((*approach + Vector3d::UnitZ()).norm(), 0.0, 0.2);
}

TEST(GripperCollision, ABallInAClosedCavityIsReachedOnlyIfTheWholeWayInFits) {
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.02);
  for (const auto& [size, free] : {std::pair(0.03, false), std::pair(0.20, false),
                                   std::pair(0.45, false), std::pair(0.47, true)}) {
    // 46 + 84 mm of gripper and 100 mm of way in.
    const TriangleMesh cavity = shapes::Inverted(shapes::Box({size, size, size}));
    const ReachedObject object(shapes::Joined(shapes::Joined(shapes::Box({1.0, 1.0, 1.0}), cavity),
                                              shapes::Sphere(0.01, 2)));
    EXPECT_EQ(object.IsFree(grasp, Vector3d::UnitZ()), free) << size;
    if (size < 0.3) {
      EXPECT_FALSE(object.FreeApproach(grasp)) << size;  // nor along a diagonal
    }
  }
}

TEST(GripperCollision, AGripperInsideTheSolidIsRefusedThoughItTouchesNothing) {
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.02);
  const TriangleMesh wall = shapes::Box({2.0, 2.0, 2.0});
  EXPECT_FALSE(ReachedObject(wall).FreeApproach(grasp));
  EXPECT_TRUE(ReachedObject(shapes::Inverted(wall)).FreeApproach(grasp));
  EXPECT_TRUE(ReachedObject(Moved(wall, 3.0, 0.0, 0.0)).FreeApproach(grasp));
}

TEST(GripperCollision, OneFingerInsideAThickWallIsEnough) {
  // The wall begins 24 mm beside the grasp: at the finger's pad, 25 mm away, the wall is 1 m thick.
  GripperModel short_way;
  short_way.palm_depth = short_way.approach_distance = 0.0;
  short_way.palm_length = 0.02;
  for (const auto& [gap, free] : {std::pair(0.024, false), std::pair(0.036, true)}) {
    for (const double side : {-1.0, 1.0}) {
      const ReachedObject object(Moved(shapes::Box({1.0, 1.0, 1.0}), side * (0.5 + gap), 0.0, 0.0),
                                 short_way);
      EXPECT_EQ(object.FreeApproach(AlongX(Vector3d::Zero(), 0.02)).has_value(), free)
          << side * gap;
    }
  }
}

TEST(GripperCollision, ATorusIsGrippedThroughItsHoleOnlyIfAFingerFitsThere) {
  // The inner finger stands 25 to 35 mm inside the ring line and is 20 mm wide.
  const ReachedObject wide(shapes::Torus(0.04, 0.01, 64, 32));
  const Grasp in_wide = AlongX({0.04, 0.0, 0.0}, 0.02);
  EXPECT_TRUE(wide.IsFree(in_wide, Vector3d::UnitZ()));
  EXPECT_TRUE(wide.IsFree(in_wide, -Vector3d::UnitZ()));
  EXPECT_FALSE(wide.IsFree(in_wide, Vector3d::UnitY()));
  const auto approach = wide.FreeApproach(in_wide);
  ASSERT_TRUE(approach);
  EXPECT_GT(std::abs(approach->z()), 0.7);
  EXPECT_FALSE(ReachedObject(shapes::Torus(0.02, 0.01, 64, 32))
                   .FreeApproach(AlongX({0.02, 0.0, 0.0}, 0.02)));
}

TEST(GripperCollision, TriesTheSideAwayFromTheCentreOfMassFirstThenItsNeighbours) {
  GripperModel model;
  model.approach_angles = 8;
  const TriangleMesh ball = shapes::Sphere(0.02, 3);
  const Grasp grasp = AlongX({0.0, 0.0, 0.01}, 0.03);
  const auto first = ReachedObject(ball, model).FreeApproach(grasp);
  ASSERT_TRUE(first);
  EXPECT_NEAR((*first + Vector3d::UnitZ()).norm(), 0.0, 1e-6);
  // Two thin walls of no weight to speak of block the first angle and the next one on one side.
  const TriangleMesh above = Moved(shapes::Box({0.1, 0.01, 1e-6}), 0.0, 0.0, 0.1);
  const auto second = ReachedObject(shapes::Joined(ball, above), model).FreeApproach(grasp);
  ASSERT_TRUE(second);
  EXPECT_NEAR(std::acos(second->dot(*first)), 45.0 * kDegree, 1e-3);
}

TEST(GripperCollision, TurnsTowardsApproachCrossAxisFirstThenTheOtherWay) {
  // Eight angles from straight down on; walls beside the grasp leave the ways from the sides.
  GripperModel model;
  model.approach_angles = 8;
  const TriangleMesh ball = shapes::Sphere(0.02, 3);
  const Grasp grasp = AlongX({0.0, 0.0, 0.01}, 0.03);
  // Step 1: -z turned by 45 degrees towards -z cross x = -y, the gripper comes from +y.
  const TriangleMesh above = Moved(shapes::Box({0.1, 0.01, 1e-6}), 0.0, 0.0, 0.1);
  const auto first = ReachedObject(shapes::Joined(ball, above), model).FreeApproach(grasp);
  ASSERT_TRUE(first);
  const double half = std::sqrt(0.5);
  EXPECT_NEAR((*first - Vector3d(0.0, -half, -half)).norm(), 0.0, 1e-6);
  // Blocked there as well, step -1 is next.
  const TriangleMesh beside = Moved(shapes::Box({0.1, 0.002, 1e-6}), 0.0, 0.07, 0.08);
  const auto second =
      ReachedObject(shapes::Joined(shapes::Joined(ball, above), beside), model).FreeApproach(grasp);
  ASSERT_TRUE(second);
  EXPECT_NEAR((*second - Vector3d(0.0, half, -half)).norm(), 0.0, 1e-3);
}

TEST(GripperCollision, MeasuresFromTheCentreOfMassNotFromTheBox) {
  // A tetrahedron of 1 cm between the fingers: its centre of mass is at 1/4 of the edge, the box's
  // centre at 1/2. The grasp is 1 mm along +y from the one.
  const ReachedObject object(Transformed(shapes::Tetrahedron(), 0.01, Vector3d::Zero()));
  const auto approach = object.FreeApproach(AlongX({0.0025, 0.0035, 0.0025}, 0.005));
  ASSERT_TRUE(approach);
  EXPECT_NEAR((*approach + Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

TEST(GripperCollision, TakesTheContactsNormalsWhereTheCentreOfMassIsOnTheGraspsLine) {
  const ReachedObject ball(shapes::Sphere(0.01, 2));
  Grasp grasp = AlongX(Vector3d::Zero(), 0.02);
  grasp.contacts[1].normal = Vector3d(1.0, 0.0, 0.2).normalized();
  EXPECT_NEAR((ball.FreeApproach(grasp).value() - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  grasp.contacts[0].normal = Vector3d(-1.0, -0.3, 0.0).normalized();
  EXPECT_NEAR((ball.FreeApproach(grasp).value() + Vector3d::UnitY()).norm(), 0.0, 1e-12);
}

TEST(GripperCollision, TakesMeshesOfNoOneAndManyFaces) {
  const Grasp grasp = AlongX(Vector3d::Zero(), 0.02);
  EXPECT_TRUE(ReachedObject(TriangleMesh{}).FreeApproach(grasp));
  TriangleMesh one;
  one.vertices = {{0.03, -1.0, -1.0}, {0.03, 2.0, -1.0}, {0.03, -1.0, 2.0}};
  one.faces = {{0, 1, 2}};
  EXPECT_FALSE(ReachedObject(one).FreeApproach(grasp));
  EXPECT_TRUE(ReachedObject(Moved(one, 0.02, 0.0, 0.0)).FreeApproach(grasp));
  TriangleMesh point = one;
  point.faces = {{1, 1, 1}};
  EXPECT_TRUE(ReachedObject(point).FreeApproach(grasp));
  const ReachedObject many(shapes::Torus(0.05, 0.02, 400, 130));
  ASSERT_GT(many.mesh.faces.size(), 100000u);
  const Grasp tube = AlongX({0.05, 0.0, 0.0}, 0.04);
  EXPECT_TRUE(many.IsFree(tube, Vector3d::UnitZ()));
  EXPECT_FALSE(many.IsFree(tube, Vector3d::UnitY()));
  EXPECT_TRUE(many.FreeApproach(tube));
}

}  // namespace
}  // namespace antigrasp
