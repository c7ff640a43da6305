#include "antigrasp/quality/force_closure.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/quality/epsilon.h"
#include "tests/quality/random_grasps.h"
#include "tests/quality/reference_cases.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Two faces of a cube, the line between the contacts turned by `angle` from the normals.
std::array<Contact, 2> Tilted(double angle) {
  const Vector3d half(0.02 * std::cos(angle), 0.02 * std::sin(angle), 0.0);
  return {Contact{-half, -Vector3d::UnitX(), 1.0}, Contact{half, Vector3d::UnitX(), 1.0}};
}

TEST(ForceClosure, IsDexNetsOnAllReferenceRowsForBothSenses) {
  int differ = 0;
  for (const ReferenceCase& c : ReadReferenceCases()) {
    EXPECT_EQ(ForceClosure(c.contacts, c.model.friction), c.force_closure) << c.id;
    EXPECT_EQ(ForceClosure(c.contacts, c.model.friction, NormalSense::kOutward),
              c.force_closure_signed)
        << c.id;
    differ += c.force_closure != c.force_closure_signed ? 1 : 0;
  }
  EXPECT_GT(differ, 20);
}

TEST(ForceClosure, EndsAtTheAngleWhoseTangentIsTheFriction) {
  for (const double friction : {0.01, 0.5, 1.0, 3.0}) {
    const double limit = std::atan(friction);
    EXPECT_TRUE(ForceClosure(Tilted(0.0), friction, NormalSense::kOutward));
    EXPECT_TRUE(ForceClosure(Tilted(limit * (1.0 - 1e-12)), friction, NormalSense::kOutward));
    EXPECT_FALSE(ForceClosure(Tilted(limit * (1.0 + 1e-12)), friction, NormalSense::kOutward));
  }
  EXPECT_TRUE(ForceClosure(Tilted(0.0), 0.0)) << "exactly opposite, no friction needed";
  EXPECT_FALSE(ForceClosure(Tilted(1e-15), 0.0));
}

TEST(ForceClosure, IncludesTheBorderOfTheConeAndContactsWithoutFrictionWhereEpsilonIsZero) {
  // A line along (1, 1, 0) between normals along x: sine and cosine are the same number.
  const std::array<Contact, 2> border = {Contact{{-0.01, -0.01, 0.0}, -Vector3d::UnitX(), 1.0},
                                         Contact{{0.01, 0.01, 0.0}, Vector3d::UnitX(), 1.0}};
  EXPECT_TRUE(ForceClosure(border, 1.0, NormalSense::kOutward));
  EXPECT_FALSE(ForceClosure(border, std::nextafter(1.0, 0.0), NormalSense::kOutward));
  WrenchModel model;
  model.friction = 1.0;
  EXPECT_EQ(Epsilon(border, Vector3d::Zero(), model), 0.0);
  model.friction = 1.1;
  EXPECT_GT(Epsilon(border, Vector3d::Zero(), model), 0.0);
  model.friction = 0.0;
  EXPECT_TRUE(ForceClosure(Tilted(0.0), 0.0, NormalSense::kOutward));
  EXPECT_EQ(Epsilon(Tilted(0.0), Vector3d::Zero(), model), 0.0);
}

TEST(ForceClosure, OnlyTheOutwardSenseNoticesNormalsTheWrongWayRound) {
  auto contacts = Tilted(0.1);
  contacts[0].normal = -contacts[0].normal;
  EXPECT_TRUE(ForceClosure(contacts, 0.5));
  EXPECT_FALSE(ForceClosure(contacts, 0.5, NormalSense::kOutward));
}

TEST(ForceClosure, DependsOnDirectionsAlone) {
  RngStream rng(21, "closure");
  int held = 0;
  for (int i = 0; i < 500; ++i) {
    const RandomGrasp grasp = DrawRandomGrasp(1.5, 8, &rng);
    const bool before = ForceClosure(grasp.contacts, grasp.model.friction, NormalSense::kOutward);
    const Eigen::Matrix3d rotation = DrawRotation(&rng);
    const Vector3d shift = DrawPoint(0.1, &rng);
    std::array<Contact, 2> moved = grasp.contacts;
    for (Contact& contact : moved) {
      contact.point = 30.0 * (rotation * contact.point + shift);
      contact.normal = 7.0 * (rotation * contact.normal);
      contact.normal_force = 0.0;
    }
    std::swap(moved[0], moved[1]);
    EXPECT_EQ(ForceClosure(moved, grasp.model.friction, NormalSense::kOutward), before) << i;
    held += before ? 1 : 0;
  }
  EXPECT_GT(held, 100);
  EXPECT_LT(held, 400);
}

TEST(ForceClosure, InTheOctagonsInscribedConeMeansEpsilonAboveZero) {
  int held = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RngStream rng(22, "closure", i);
    const RandomGrasp grasp = DrawRandomGrasp(1.5, 8, &rng);
    const double inscribed = grasp.model.friction * std::cos(std::numbers::pi / 8.0);
    if (!ForceClosure(grasp.contacts, inscribed * (1.0 - 1e-6), NormalSense::kOutward)) continue;
    EXPECT_GT(Epsilon(grasp.contacts, grasp.com, grasp.model), 0.0) << i;
    ++held;
  }
  EXPECT_GT(held, 200);
}

TEST(ForceClosure, IsFalseWhereThereIsNoLineOrNoNormal) {
  for (const NormalSense sense : {NormalSense::kLine, NormalSense::kOutward}) {
    auto contacts = Tilted(0.0);
    contacts[1].point = contacts[0].point;
    EXPECT_FALSE(ForceClosure(contacts, 0.5, sense));
    contacts = Tilted(0.0);
    contacts[1].normal.setZero();
    EXPECT_FALSE(ForceClosure(contacts, 0.5, sense));
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      contacts = Tilted(0.0);
      contacts[0].normal.y() = bad;
      EXPECT_FALSE(ForceClosure(contacts, 0.5, sense));
      contacts = Tilted(0.0);
      contacts[0].point.y() = bad;
      EXPECT_FALSE(ForceClosure(contacts, 0.5, sense));
    }
    EXPECT_FALSE(ForceClosure(Tilted(0.0), std::nan(""), sense));
  }
}

}  // namespace
}  // namespace antigrasp
