#include "antigrasp/quality/epsilon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/quality/random_grasps.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Two contacts in the middle of opposite faces of a cube with 4 cm edges.
std::array<Contact, 2> CubeGrasp() {
  return {Contact{Vector3d(-0.02, 0.0, 0.0), -Vector3d::UnitX(), 1.0},
          Contact{Vector3d(0.02, 0.0, 0.0), Vector3d::UnitX(), 1.0}};
}

TangentFrames OwnFrames(const std::array<Contact, 2>& contacts) {
  return {TangentFrame(-contacts[0].normal), TangentFrame(-contacts[1].normal)};
}

double EpsilonOf(const RandomGrasp& grasp) {
  return Epsilon(grasp.contacts, grasp.com, grasp.model);
}

TEST(Epsilon, CubeGraspIsJustUnderTheTorsionCap) {
  const WrenchModel model;
  const double cap = std::numbers::pi * 0.005 * 0.005 * 0.5 * 1000.0;  // 0.03927
  const double epsilon = Epsilon(CubeGrasp(), Vector3d::Zero(), model);
  EXPECT_NEAR(epsilon, 0.0391, 5e-5);
  EXPECT_LT(epsilon, cap);
}

TEST(Epsilon, NeverExceedsAnyDirectionOfTheWrenchHull) {
  RngStream rng(3, "support");
  for (int i = 0; i < 200; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(1.0, 8, &rng);
    const double epsilon = EpsilonOf(grasp);
    const auto wrenches = GraspMatrix(grasp.contacts, grasp.com, grasp.model);
    for (int k = 0; k < 100; ++k) {
      Eigen::Matrix<double, 6, 1> direction;
      for (int m = 0; m < 6; ++m) direction[m] = rng.Normal();
      direction.normalize();
      EXPECT_GE((direction.transpose() * wrenches).maxCoeff(), epsilon);
    }
  }
}

TEST(Epsilon, DoesNotChangeUnderARigidMotionOfEverythingWithTheFrames) {
  RngStream rng(4, "rigid");
  for (int i = 0; i < 300; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(1.2, 8, &rng);
    const TangentFrames frames = OwnFrames(grasp.contacts);
    const Eigen::Matrix3d rotation = DrawRotation(&rng);
    const Vector3d shift = DrawPoint(0.1, &rng);
    RandomGrasp moved = grasp;
    TangentFrames moved_frames = frames;
    for (std::size_t k = 0; k < 2; ++k) {
      moved.contacts[k].point = rotation * grasp.contacts[k].point + shift;
      moved.contacts[k].normal = rotation * grasp.contacts[k].normal;
      for (Vector3d& t : moved_frames[k]) t = rotation * t;
    }
    moved.com = rotation * grasp.com + shift;
    const double before = Epsilon(grasp.contacts, grasp.com, grasp.model, frames);
    EXPECT_NEAR(Epsilon(moved.contacts, moved.com, moved.model, moved_frames), before,
                1e-12 + 1e-8 * before);
  }
}

TEST(Epsilon, DoesNotChangeUnderARotationAboutX) {
  // The frame is tied to the x axis, so it turns with everything else.
  RngStream rng(5, "about_x");
  for (int i = 0; i < 200; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(1.0, 8, &rng);
    const Eigen::AngleAxisd rotation(rng.Uniform(0.0, 6.0), Vector3d::UnitX());
    RandomGrasp moved = grasp;
    for (Contact& contact : moved.contacts) {
      contact.point = rotation * contact.point;
      contact.normal = rotation * contact.normal;
    }
    moved.com = rotation * grasp.com;
    const double before = EpsilonOf(grasp);
    EXPECT_NEAR(EpsilonOf(moved), before, 1e-12 + 1e-8 * before);
  }
}

TEST(Epsilon, DependsOnTheFrameBecauseTheConeIsAnOctagon) {
  RngStream rng(6, "frame");
  int changed = 0;
  for (int i = 0; i < 50; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(0.8, 8, &rng);
    TangentFrames turned = OwnFrames(grasp.contacts);
    for (auto& [t1, t2] : turned) {
      const double angle = std::numbers::pi / 8.0;
      const Vector3d u = std::cos(angle) * t1 + std::sin(angle) * t2;
      t2 = std::cos(angle) * t2 - std::sin(angle) * t1;
      t1 = u;
    }
    const double before = EpsilonOf(grasp);
    const double after = Epsilon(grasp.contacts, grasp.com, grasp.model, turned);
    changed += std::abs(after - before) > 1e-3 * before ? 1 : 0;
  }
  EXPECT_GT(changed, 25);
}

TEST(Epsilon, SwappingTheContactsChangesNothing) {
  RngStream rng(7, "swap");
  for (int i = 0; i < 300; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(1.3, 8, &rng);
    const double before = EpsilonOf(grasp);
    EXPECT_NEAR(Epsilon({grasp.contacts[1], grasp.contacts[0]}, grasp.com, grasp.model), before,
                1e-12 + 1e-9 * before);
  }
}

TEST(Epsilon, IsProportionalToTheForcesAndUnchangedByTheUnitOfLength) {
  RngStream rng(8, "scale");
  for (int i = 0; i < 300; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(1.0, 8, &rng);
    const double before = EpsilonOf(grasp);
    RandomGrasp stronger = grasp;
    for (Contact& contact : stronger.contacts) contact.normal_force *= 3.0;
    EXPECT_NEAR(EpsilonOf(stronger), 3.0 * before, 1e-12 + 1e-9 * before);
    RandomGrasp larger = grasp;  // torsion goes with r^2 s: not a torque, so r by the root
    for (Contact& contact : larger.contacts) contact.point *= 100.0;
    larger.com *= 100.0;
    larger.model.torque_scale /= 100.0;
    larger.model.finger_radius *= 10.0;
    EXPECT_NEAR(EpsilonOf(larger), before, 1e-12 + 1e-9 * before);
  }
}

TEST(Epsilon, MoreFrictionNeverMakesTheGraspWorse) {
  RngStream rng(9, "friction");
  int held = 0;
  for (int i = 0; i < 200; ++i) {
    RandomGrasp grasp = DrawRandomGrasp(1.5, 8, &rng);
    double last = 0.0;
    for (const double friction : {0.05, 0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 5.0}) {
      grasp.model.friction = friction;
      const double epsilon = EpsilonOf(grasp);
      EXPECT_GE(epsilon, last - 1e-12);
      last = epsilon;
    }
    held += last > 0.0 ? 1 : 0;
  }
  EXPECT_GT(held, 150);
}

TEST(Epsilon, ForceClosureEndsWhereTheContactLineLeavesTheCone) {
  // Parallel faces, the line between the contacts tilted towards an octagon corner.
  const double limit = std::atan(0.5);
  for (const double share : {0.5, 0.9, 0.999, 1.001, 1.1, 2.0}) {
    const Vector3d half(0.02 * std::sin(share * limit), 0.0, 0.02 * std::cos(share * limit));
    const std::array<Contact, 2> contacts{Contact{-half, -Vector3d::UnitZ(), 1.0},
                                          Contact{half, Vector3d::UnitZ(), 1.0}};
    EXPECT_EQ(Epsilon(contacts, Vector3d::Zero(), {}) > 0.0, share < 1.0) << share;
  }
}

TEST(Epsilon, IsZeroWhereTheWrenchesCannotSurroundTheOrigin) {
  const WrenchModel model;
  const Vector3d com = Vector3d::Zero();
  auto contacts = CubeGrasp();
  contacts[0].normal_force = 0.0;
  EXPECT_EQ(Epsilon(contacts, com, model), 0.0) << "a contact without force";
  contacts = CubeGrasp();
  contacts[1].point = contacts[0].point;
  EXPECT_EQ(Epsilon(contacts, com, model), 0.0) << "coincident contacts";
  contacts = CubeGrasp();
  contacts[1].normal = contacts[0].normal;
  EXPECT_EQ(Epsilon(contacts, com, model), 0.0) << "both push the same way";
  contacts = CubeGrasp();
  contacts[0].normal = contacts[1].normal = Vector3d::UnitZ();
  EXPECT_EQ(Epsilon(contacts, com, model), 0.0) << "both on one face";
  EXPECT_EQ(Epsilon(CubeGrasp(), com, {0.0, 8, 0.005, 1000.0}), 0.0) << "no friction";
  EXPECT_EQ(Epsilon(CubeGrasp(), com, {0.5, 8, 0.0, 1000.0}), 0.0) << "no torsion";
}

TEST(Epsilon, TwoHardFingersNeverHoldTheObjectAgainstATurnAboutTheirLine) {
  WrenchModel model;
  model.torsion = Torsion::kNone;
  EXPECT_EQ(Epsilon(CubeGrasp(), Vector3d::Zero(), model), 0.0);
  RngStream rng(15, "hard");
  for (int i = 0; i < 100; ++i) {
    RandomGrasp grasp = DrawRandomGrasp(1.0, 8, &rng);
    grasp.model.torsion = Torsion::kNone;
    EXPECT_EQ(EpsilonOf(grasp), 0.0);
    // The torque about the line vanishes in every column, which is why.
    const Vector3d line = grasp.contacts[1].point - grasp.contacts[0].point;
    const auto wrenches = GraspMatrix(grasp.contacts, grasp.contacts[0].point, grasp.model);
    ASSERT_EQ(wrenches.cols(), 16);
    EXPECT_LT((line.transpose() * wrenches.bottomRows<3>()).norm(), 1e-14 * wrenches.norm());
  }
}

TEST(Epsilon, UniformPressureTurnsHarderThanDexNetsTorsionByTheFormulas) {
  // 2/3 r mu against pi r^2 mu: at r = 5 mm the first is 2 / (3 pi 0.005) = 42.4 times the second.
  WrenchModel model;
  const double dexnet = TorsionLimit(model);
  EXPECT_NEAR(dexnet, std::numbers::pi * 0.005 * 0.005 * 0.5, 1e-19);
  model.torsion = Torsion::kUniformPressure;
  EXPECT_NEAR(TorsionLimit(model), 0.005 / 3.0, 1e-18);
  EXPECT_NEAR(TorsionLimit(model) / dexnet, 2.0 / (3.0 * std::numbers::pi * 0.005), 1e-9);
  // The nearest facet's normal pushes one contact sideways by l, through an octagon's side (c l),
  // the other not at all (torque l / 20 about z), both along the line by c l and twists by c l / T.
  const double c = 0.5 * std::cos(std::numbers::pi / 8.0);
  const double twist = 1000.0 * TorsionLimit(model);
  EXPECT_NEAR(Epsilon(CubeGrasp(), Vector3d::Zero(), model),
              c / std::sqrt(1.0 + 1.0 / 400.0 + c * c + c * c / (twist * twist)), 1e-12);
}

TEST(Epsilon, IsZeroUnlessTheOriginIsDeeperThanRounding) {
  auto contacts = CubeGrasp();
  const double full = Epsilon(contacts, Vector3d::Zero(), {});
  for (const double depth : {0.5e-10, 2e-10}) {
    for (Contact& contact : contacts) contact.normal_force = depth / full;
    const double epsilon = Epsilon(contacts, Vector3d::Zero(), {});
    EXPECT_NEAR(epsilon, depth > 1e-10 ? depth : 0.0, 1e-18);
  }
}

TEST(Epsilon, IsZeroForNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf}) {
    auto contacts = CubeGrasp();
    contacts[0].point.y() = bad;
    EXPECT_EQ(Epsilon(contacts, Vector3d::Zero(), {}), 0.0);
    EXPECT_EQ(Epsilon(CubeGrasp(), Vector3d(bad, 0.0, 0.0), {}), 0.0);
    EXPECT_EQ(Epsilon(CubeGrasp(), Vector3d::Zero(), {bad, 8, 0.005, 1000.0}), 0.0);
  }
}

TEST(Epsilon, FewerThanThreeConeEdgesIsABug) {
  EXPECT_THROW(Epsilon(CubeGrasp(), Vector3d::Zero(), {0.5, 2, 0.005, 1000.0}), std::logic_error);
  EXPECT_THROW(GraspMatrix(CubeGrasp(), Vector3d::Zero(), {0.5, 2, 0.005, 1000.0}),
               std::logic_error);
}

TEST(Epsilon, ManyConeEdgesApproachTheRoundConeFromBelow) {
  double last = 0.0;
  for (const int edges : {4, 8, 16, 32, 64}) {  // each polygon contains the one before
    RngStream rng(10, "edges");
    const RandomGrasp grasp = DrawRandomGrasp(0.6, edges, &rng);
    const double epsilon = EpsilonOf(grasp);
    EXPECT_GE(epsilon, last - 1e-12) << edges;
    if (edges == 64) {
      EXPECT_NEAR(epsilon, last, 0.01 * last);
    }
    last = epsilon;
  }
}

TEST(GraspMatrix, HasFrictionEdgesThenTorsionPairs) {
  const WrenchModel model;
  const auto wrenches = GraspMatrix(CubeGrasp(), Vector3d::Zero(), model);
  ASSERT_EQ(wrenches.cols(), 20);
  for (int k = 0; k < 16; ++k) {
    const Vector3d force = wrenches.col(k).head<3>();
    EXPECT_NEAR(force.norm(), std::sqrt(1.25), 1e-14);
    EXPECT_NEAR(force.x(), k < 8 ? 1.0 : -1.0, 1e-14);
  }
  const double torsion = std::numbers::pi * 0.005 * 0.005 * 0.5 * 1000.0;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(wrenches.col(16 + i).head<3>().isZero(0.0));
    EXPECT_NEAR(wrenches(3, 16 + i), i == 0 ? torsion : -torsion, 1e-15);
    EXPECT_TRUE((wrenches.col(18 + i) + wrenches.col(16 + i)).isZero(0.0));
  }
  // First edge along +y (the frame at the pole), arm -0.02 x: torque -0.02 * 0.5 * 1000 about z.
  EXPECT_NEAR(wrenches(1, 0), 0.5, 1e-15);
  EXPECT_NEAR(wrenches(5, 0), -10.0, 1e-13);
}

TEST(GraspMatrix, ColumnsGoRoundFromTheFirstTangentToTheSecondAboutTheCentreOfMass) {
  // Contact 1 presses with 2 N along d = z: t1 = x, t2 = z cross x = y. Friction 1/2, 4 edges.
  const std::array<Contact, 2> contacts{Contact{Vector3d(1.0, 2.0, 3.0), -Vector3d::UnitZ(), 2.0},
                                        Contact{Vector3d(1.0, 2.0, 9.0), Vector3d::UnitZ(), 3.0}};
  const auto wrenches =
      GraspMatrix(contacts, Vector3d(1.0, 1.0, 1.0), {0.5, 4, 0.1, 10.0, Torsion::kDexNet});
  ASSERT_EQ(wrenches.cols(), 12);
  const auto expect = [&](int column, const Vector3d& force, const Vector3d& torque) {
    EXPECT_LT((wrenches.col(column).head<3>() - force).norm(), 1e-14) << column;
    EXPECT_LT((wrenches.col(column).tail<3>() - 10.0 * torque).norm(), 1e-12) << column;
  };
  // Arm (0, 1, 2); torque (1 fz - 2 fy, 2 fx, -fx).
  expect(0, {1.0, 0.0, 2.0}, {2.0, 2.0, -1.0});
  expect(1, {0.0, 1.0, 2.0}, {0.0, 0.0, 0.0});
  expect(2, {-1.0, 0.0, 2.0}, {2.0, -2.0, 1.0});
  expect(3, {0.0, -1.0, 2.0}, {4.0, 0.0, 0.0});
  // Contact 2, d = -z: t2 = -z cross x = -y. Arm (0, 1, 8): torque (fz - 8 fy, 8 fx, -fx).
  expect(4, {1.5, 0.0, -3.0}, {-3.0, 12.0, -1.5});
  expect(5, {0.0, -1.5, -3.0}, {9.0, 0.0, 0.0});
  // Torsion pi r^2 mu by the normal force, about each contact's own inward normal.
  const double torsion = std::numbers::pi * 0.01 * 0.5;
  expect(8, Vector3d::Zero(), {0.0, 0.0, 2.0 * torsion});
  expect(9, Vector3d::Zero(), {0.0, 0.0, -3.0 * torsion});
  expect(10, Vector3d::Zero(), {0.0, 0.0, -2.0 * torsion});
  expect(11, Vector3d::Zero(), {0.0, 0.0, 3.0 * torsion});
}

}  // namespace
}  // namespace antigrasp
