#include "antigrasp/quality/jaw_closing.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
constexpr double kOpening = 0.05;
constexpr double kFriction = 0.5;

TEST(CloseJaws, TouchesOppositeFacesOfABox) {
  const RayScene scene(shapes::Box({0.03, 0.04, 0.05}));
  const auto contacts =
      CloseJaws(scene, Vector3d(0.002, 0.01, 0.0), Vector3d::UnitX(), kOpening, kFriction);
  ASSERT_TRUE(contacts.has_value());
  EXPECT_LT(((*contacts)[0].point - Vector3d(-0.015, 0.01, 0.0)).norm(), 1e-15);
  EXPECT_LT(((*contacts)[1].point - Vector3d(0.015, 0.01, 0.0)).norm(), 1e-15);
  EXPECT_EQ((*contacts)[0].normal, -Vector3d::UnitX());
  EXPECT_EQ((*contacts)[1].normal, Vector3d::UnitX());
  EXPECT_EQ((*contacts)[0].normal_force, 1.0);
  EXPECT_EQ((*contacts)[1].normal_force, 1.0);
}

TEST(CloseJaws, ATiltedAxisPressesWithItsNormalPart) {
  const RayScene scene(shapes::Box({0.03, 0.04, 0.05}));
  const Vector3d axis(std::cos(0.3), std::sin(0.3), 0.0);
  const auto contacts = CloseJaws(scene, Vector3d::Zero(), axis, kOpening, kFriction);
  ASSERT_TRUE(contacts.has_value());
  for (const Contact& contact : *contacts) EXPECT_NEAR(contact.normal_force, std::cos(0.3), 1e-15);
}

TEST(CloseJaws, EachJawPressesWithTheNormalPartOfItsOwnFace) {
  // A wedge: the face at -x is upright, that at +x leans by atan(1/4) and is 15 mm away at y = 0.
  TriangleMesh wedge = shapes::Box({0.03, 0.04, 0.05});
  for (Eigen::Vector3d& v : wedge.vertices) {
    if (v.x() > 0.0) v.x() -= 0.25 * v.y();
  }
  const RayScene scene(wedge);
  const auto contacts =
      CloseJaws(scene, Vector3d(0.0, 0.004, 0.0), Vector3d::UnitX(), kOpening, kFriction);
  ASSERT_TRUE(contacts.has_value());
  EXPECT_LT(((*contacts)[0].point - Vector3d(-0.015, 0.004, 0.0)).norm(), 1e-15);
  EXPECT_LT(((*contacts)[1].point - Vector3d(0.014, 0.004, 0.0)).norm(), 1e-15);
  EXPECT_NEAR((*contacts)[0].normal_force, 1.0, 1e-15);
  EXPECT_NEAR((*contacts)[1].normal_force, 4.0 / std::sqrt(17.0), 1e-15);
  EXPECT_LT(((*contacts)[1].normal - Vector3d(4.0, 1.0, 0.0) / std::sqrt(17.0)).norm(), 1e-15);
  // From the other side the same two change places.
  const auto turned =
      CloseJaws(scene, Vector3d(0.0, 0.004, 0.0), -Vector3d::UnitX(), kOpening, kFriction);
  ASSERT_TRUE(turned.has_value());
  EXPECT_EQ((*turned)[0].point, (*contacts)[1].point);
  EXPECT_NEAR((*turned)[0].normal_force, 4.0 / std::sqrt(17.0), 1e-15);
  EXPECT_FALSE(CloseJaws(scene, Vector3d(0.0, 0.004, 0.0), Vector3d::UnitX(), kOpening, 0.24));
  EXPECT_FALSE(CloseJaws(scene, Vector3d(0.0, 0.004, 0.0), -Vector3d::UnitX(), kOpening, 0.24));
}

TEST(CloseJaws, SlipsWhenTheAxisLeavesTheFrictionCone) {
  const RayScene scene(shapes::Box({0.03, 0.04, 0.05}));
  for (const double offset : {-0.01, 0.01}) {
    const double angle = std::atan(kFriction) + offset;
    const Vector3d axis(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_EQ(CloseJaws(scene, Vector3d::Zero(), axis, kOpening, kFriction).has_value(),
              offset < 0.0);
  }
}

TEST(CloseJaws, FailsWhenAJawStartsInsideTheObject) {
  const RayScene scene(shapes::Box({0.04, 0.04, 0.04}));
  const Vector3d x = Vector3d::UnitX();
  EXPECT_TRUE(CloseJaws(scene, 0.0049 * x, x, kOpening, kFriction).has_value());
  EXPECT_FALSE(CloseJaws(scene, 0.0051 * x, x, kOpening, kFriction).has_value());
  EXPECT_FALSE(CloseJaws(scene, -0.0051 * x, x, kOpening, kFriction).has_value());
}

TEST(CloseJaws, FailsWhenAJawReachesTheCentreWithoutTouching) {
  const RayScene scene(shapes::Box({0.01, 0.04, 0.04}));
  const Vector3d x = Vector3d::UnitX();
  EXPECT_TRUE(CloseJaws(scene, 0.004 * x, x, kOpening, kFriction).has_value());
  EXPECT_FALSE(CloseJaws(scene, 0.006 * x, x, kOpening, kFriction).has_value());
  EXPECT_FALSE(CloseJaws(scene, Vector3d(0.0, 0.03, 0.0), x, kOpening, kFriction).has_value());
}

TEST(CloseJaws, MeetsTheOuterOfTwoBodies) {
  const Vector3d x = Vector3d::UnitX();
  const TriangleMesh plate = shapes::Box({0.004, 0.04, 0.04});
  const Eigen::Vector3d zero = Vector3d::Zero();
  const RayScene scene(
      shapes::Joined(Transformed(plate, 1.0, -0.01 * x), Transformed(plate, 1.0, 0.01 * x)));
  const auto contacts = CloseJaws(scene, zero, x, kOpening, kFriction);
  ASSERT_TRUE(contacts.has_value());
  EXPECT_NEAR((*contacts)[0].point.x(), -0.012, 1e-15);
  EXPECT_NEAR((*contacts)[1].point.x(), 0.012, 1e-15);
}

TEST(CloseJaws, AnInvertedObjectCannotBeTouched) {
  const RayScene scene(shapes::Inverted(shapes::Box({0.03, 0.03, 0.03})));
  EXPECT_FALSE(CloseJaws(scene, Vector3d::Zero(), Vector3d::UnitX(), kOpening, kFriction));
}

// Some jaws miss, some slip at their own friction, some start inside.
TEST(CloseJawsTogether, GivesEachWhatItGivesAlone) {
  TriangleMesh wedge = shapes::Box({0.03, 0.04, 0.05});
  for (Eigen::Vector3d& v : wedge.vertices) {
    if (v.x() > 0.0) v.x() -= 0.25 * v.y();
  }
  const RayScene scene(wedge);
  RngStream rng(1, "jaws");
  std::vector<JawClosing> closings;
  for (int i = 0; i < 300; ++i) {
    closings.push_back({DrawPoint(0.009, &rng),
                        (Vector3d::UnitX() + DrawPoint(0.1, &rng)).normalized(), rng.Uniform()});
  }
  std::vector<std::optional<std::array<Contact, 2>>> contacts(closings.size());
  CloseJawsTogether(scene, closings, kOpening, contacts);
  int closed = 0;
  for (std::size_t i = 0; i < closings.size(); ++i) {
    const JawClosing& jaws = closings[i];
    const auto alone = CloseJaws(scene, jaws.center, jaws.axis, kOpening, jaws.friction);
    ASSERT_EQ(contacts[i].has_value(), alone.has_value()) << i;
    if (!alone) continue;
    ++closed;
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ((*contacts[i])[k].point, (*alone)[k].point) << i;
      EXPECT_EQ((*contacts[i])[k].normal, (*alone)[k].normal) << i;
      EXPECT_EQ((*contacts[i])[k].normal_force, (*alone)[k].normal_force) << i;
    }
  }
  EXPECT_GT(closed, 30);
  EXPECT_LT(closed, 270);
}

}  // namespace
}  // namespace antigrasp
