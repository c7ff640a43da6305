#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include "antigrasp/contact/mesh_contact.h"
#include "tests/support/contact_shapes.h"
#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPadMargin = 0.2e-3;
constexpr double kPadDegree = std::numbers::pi / 180.0;

// A pad of 8 mm by 2 half_y by 2 half_z whose front face is at `front` and looks along -x, turned
// about x by this angle.
PadPose PadFromRight(const Vector3d& front, double half_y, double half_z, double degrees = 0.0) {
  Matrix3d axes;
  axes.col(0) = -Vector3d::UnitX();
  axes.col(1) = AngleAxisd(degrees * kPadDegree, Vector3d::UnitX()) * Vector3d::UnitY();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return {front + Vector3d(0.004, 0.0, 0.0), axes, {0.004, half_y, half_z}};
}

std::vector<SurfaceContact> PadTouches(const ContactSolid& solid, const PadPose& pad, int most = 8,
                                       TouchCache* cache = nullptr, bool exact_load = false) {
  std::vector<SurfaceContact> contacts(static_cast<std::size_t>(most));
  contacts.resize(solid.Touch(pad, kPadMargin, contacts.data(), most, cache, exact_load));
  return contacts;
}

// All of them on x = 0.02 +- distance / 2 with this normal, at these places (y, z), once each.
void ExpectPatch(const std::vector<SurfaceContact>& contacts,
                 const std::vector<Eigen::Vector2d>& places, double distance) {
  ASSERT_EQ(contacts.size(), places.size());
  for (const Eigen::Vector2d& place : places) {
    int found = 0;
    for (const SurfaceContact& contact : contacts) {
      found +=
          (contact.position - Vector3d(0.02 + 0.5 * distance, place.x(), place.y())).norm() < 1e-9;
    }
    EXPECT_EQ(found, 1) << place.transpose();
  }
  for (const SurfaceContact& contact : contacts) {
    EXPECT_NEAR(contact.distance, distance, 1e-12);
    EXPECT_LT((contact.normal - Vector3d::UnitX()).norm(), 1e-12);
  }
}

// A cube of 40 mm with 2 triangles a face, and with 128.
std::vector<ContactSolid> Cubes() {
  std::vector<ContactSolid> cubes;
  for (const int times : {0, 3}) {
    cubes.emplace_back(shapes::Subdivided(shapes::Box({0.04, 0.04, 0.04}), times));
  }
  return cubes;
}

TEST(PadContact, FlatOnAFaceIsAtThePadsCorners) {
  const double y = 0.01;
  const double z = 0.006;
  for (const ContactSolid& cube : Cubes()) {
    ExpectPatch(PadTouches(cube, PadFromRight({0.01998, 0.003, -0.002}, y, z)),
                {{0.013, 0.004}, {0.013, -0.008}, {-0.007, 0.004}, {-0.007, -0.008}}, -0.00002);
    const double c = std::cos(30.0 * kPadDegree);
    const double s = std::sin(30.0 * kPadDegree);
    ExpectPatch(PadTouches(cube, PadFromRight({0.02001, 0.0, 0.0}, y, z, 30.0)),
                {{c * y - s * z, s * y + c * z},
                 {-c * y + s * z, -s * y - c * z},
                 {c * y + s * z, s * y - c * z},
                 {-c * y - s * z, -s * y + c * z}},
                0.00001);
  }
}

TEST(PadContact, OfALargerPadThatIsTurnedIsAtTheEightCornersOfTheCommonPolygon) {
  // Where the sides of a square of 44 mm, turned by 30 degrees, cut those of one of 40 mm.
  const double far = (0.022 - 0.02 * std::sin(30.0 * kPadDegree)) / std::cos(30.0 * kPadDegree);
  const double near = (0.022 - 0.02 * std::cos(30.0 * kPadDegree)) / std::sin(30.0 * kPadDegree);
  const double a = 0.02;
  for (const ContactSolid& cube : Cubes()) {
    ExpectPatch(PadTouches(cube, PadFromRight({0.02, 0.0, 0.0}, 0.022, 0.022, 30.0)),
                {{a, near},
                 {far, a},
                 {-near, a},
                 {-a, far},
                 {-a, -near},
                 {-far, -a},
                 {near, -a},
                 {a, -far}},
                0.0);
  }
}

TEST(PadContact, OverAnEdgeEndsThere) {
  for (const ContactSolid& cube : Cubes()) {
    ExpectPatch(PadTouches(cube, PadFromRight({0.01999, 0.02, 0.0}, 0.01, 0.006)),
                {{0.02, 0.006}, {0.02, -0.006}, {0.01, 0.006}, {0.01, -0.006}}, -0.00001);
    EXPECT_TRUE(PadTouches(cube, PadFromRight({0.01999, 0.031, 0.0}, 0.01, 0.006)).empty());
    EXPECT_TRUE(PadTouches(cube, PadFromRight({0.02021, 0.0, 0.0}, 0.01, 0.006)).empty());
  }
}

TEST(PadContact, AcrossACylinderIsItsLine) {
  // An edge of the 64-gon is foremost; its neighbours stand 96 um back, the margin is at 200 um, of
  // which 10 um are the depth.
  const ContactSolid cylinder(shapes::Cylinder(0.02, 0.06, 64));
  const auto contacts = PadTouches(cylinder, PadFromRight({0.01999, 0.001, 0.0}, 0.01, 0.006));
  ASSERT_GE(contacts.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(contacts[i].distance, -0.00001, 1e-12);
    EXPECT_NEAR(contacts[i].position.y(), 0.0, 1e-12);
    EXPECT_NEAR(std::abs(contacts[i].position.z()), 0.006, 1e-12);
    EXPECT_LT((contacts[i].normal - Vector3d::UnitX()).norm(), 1e-12);
  }
  EXPECT_LT(contacts[0].position.z() * contacts[1].position.z(), 0.0);
  for (std::size_t i = 2; i < contacts.size(); ++i) {
    EXPECT_GT(contacts[i].distance, 0.00008);
    EXPECT_LT(std::abs(contacts[i].position.y()), 0.004);
  }
}

TEST(PadContact, AtTheRimHasTheNormalOfAFaceThatRisesBeyondIt) {
  // The front face is turned by 10 degrees about z: its rim at +y comes nearest.
  PadPose pad = PadFromRight(Vector3d::Zero(), 0.01, 0.006);
  pad.axes = AngleAxisd(10.0 * kPadDegree, Vector3d::UnitZ()).toRotationMatrix() * pad.axes;
  const Vector3d to_rim = pad.half[0] * pad.axes.col(0) + pad.half[1] * pad.axes.col(1);
  pad.center = Vector3d(0.02 - 0.00003, 0.0, 0.0) - to_rim;
  for (const ContactSolid& cube : Cubes()) {
    const auto contacts = PadTouches(cube, pad);
    ASSERT_GE(contacts.size(), 2U);
    for (int i = 0; i < 2; ++i) {
      EXPECT_NEAR(contacts[i].distance, -0.00003, 1e-12);
      EXPECT_LT((contacts[i].normal - Vector3d::UnitX()).norm(), 1e-12);
      EXPECT_NEAR(contacts[i].position.y(), 0.0, 1e-12);
      EXPECT_NEAR(contacts[i].position.x(), 0.02 - 0.000015, 1e-12);
    }
    EXPECT_NEAR(std::abs(contacts[0].position.z()), 0.006, 1e-12);
    EXPECT_LT(contacts[0].position.z() * contacts[1].position.z(), 0.0);
    for (std::size_t i = 2; i < contacts.size(); ++i) EXPECT_GT(contacts[i].distance, 0.00015);
  }
}

TEST(PadContact, AtTheRimKeepsThePadsNormalWhereTheFaceFallsAway) {
  // A roof of 20 degrees: its ridge runs along z under the middle of a narrow pad, its sides leave
  // across the rim, 63 um below the front face.
  const double fall = 0.02 * std::tan(20.0 * kPadDegree);
  const ContactSolid roof(shapes::Extruded(
      {{-0.02, -0.02}, {0.02 - fall, -0.02}, {0.02, 0.0}, {0.02 - fall, 0.02}, {-0.02, 0.02}},
      {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}}, 0.04));
  const auto contacts = PadTouches(roof, PadFromRight({0.01999, 0.0, 0.0}, 0.0002, 0.006));
  ASSERT_GE(contacts.size(), 2U);
  for (const SurfaceContact& contact : contacts) {
    EXPECT_LT((contact.normal - Vector3d::UnitX()).norm(), 1e-12);
  }
  EXPECT_NEAR(contacts[0].distance, -0.00001, 1e-12);
}

TEST(PadContact, KeepsADeeperBumpInsideThePatch) {
  TriangleMesh mesh = shapes::Subdivided(shapes::Box({0.04, 0.04, 0.04}), 3);
  for (Vector3d& v : mesh.vertices) {
    if (v.x() > 0.0199 && v.tail<2>().norm() < 1e-9) v.x() += 0.00005;
  }
  const auto contacts =
      PadTouches(ContactSolid(mesh), PadFromRight({0.02004, 0.001, 0.0}, 0.009, 0.009), 5);
  ASSERT_EQ(contacts.size(), 5U);
  EXPECT_NEAR(contacts[0].distance, -0.00001, 1e-12);
  EXPECT_LT((contacts[0].position - Vector3d(0.020045, 0.0, 0.0)).norm(), 1e-9);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_NEAR(contacts[i].distance, 0.00004, 1e-12);
    EXPECT_NEAR(std::abs(contacts[i].position.z()), 0.009, 1e-9);
  }
}

TEST(PadContact, StandsOnEveryBumpThatBearsIt) {
  // Three bumps of 0.1 mm, 1 to 11 um deep, none of them at the outline of what is near.
  TriangleMesh mesh = shapes::Subdivided(shapes::Box({0.04, 0.04, 0.04}), 3);
  const std::array<Vector3d, 3> tops{
      {{0.020101, 0.005, 0.0}, {0.020106, -0.005, 0.005}, {0.020111, -0.005, -0.005}}};
  for (Vector3d& v : mesh.vertices) {
    for (const Vector3d& top : tops) {
      if (v.x() > 0.0199 && (v - top).tail<2>().norm() < 1e-9) v.x() = top.x();
    }
  }
  const auto contacts =
      PadTouches(ContactSolid(mesh), PadFromRight({0.0201, 0.0, 0.0}, 0.012, 0.012));
  ASSERT_GE(contacts.size(), 3U);
  for (const Vector3d& top : tops) {
    int found = 0;
    for (int i = 0; i < 3; ++i) {
      found += (contacts[i].position - top).tail<2>().norm() < 1e-9 &&
               std::abs(contacts[i].distance - (0.0201 - top.x())) < 1e-12;
    }
    EXPECT_EQ(found, 1) << top.transpose();
  }
}

// The foremost edge of the 64-gon leans by this angle: one end at the rim is deeper, and it is no
// longer the only one that bears as soon as it is 20 um deeper.
TEST(PadContact, OnARidgeThatLeansBearsAtBothEnds) {
  const ContactSolid cylinder(shapes::Cylinder(0.02, 0.06, 64));
  for (const double degrees : {0.0, 0.02, 0.2, 0.3, -0.3}) {
    PadPose pad = PadFromRight({0.01996, 0.001, 0.0}, 0.01, 0.006);
    const double lean = degrees * kPadDegree;
    const Vector3d front = pad.Front();
    pad.axes = AngleAxisd(lean, Vector3d::UnitY()).toRotationMatrix() * pad.axes;
    pad.center = front - pad.half[0] * pad.axes.col(0);
    for (const double end : {-1.0, 1.0}) {
      const double depth = 0.04e-3 - end * 0.006 * std::sin(lean);
      int found = 0;
      for (const SurfaceContact& contact : PadTouches(cylinder, pad, 8, nullptr, true)) {
        found += contact.position.z() * end > 0.0055 && std::abs(contact.position.y()) < 1e-9 &&
                 std::abs(contact.distance + depth) < 1e-6;
      }
      EXPECT_EQ(found, 1) << degrees << " degrees, end " << end << ", depth " << depth;
    }
  }
}

// A step of 4 mm beside the pad, whose side is 0.1 mm in it; the front is 0.05 mm above the floor.
TEST(PadContact, OfAStepThatComesInFromTheSideIsThatSides) {
  const ContactSolid stairs(shapes::Extruded(
      {{-0.02, -0.02}, {0.016, -0.02}, {0.016, 0.0}, {0.02, 0.0}, {0.02, 0.02}, {-0.02, 0.02}},
      {{0, 1, 2}, {0, 2, 5}, {2, 3, 4}, {2, 4, 5}}, 0.04));
  const auto contacts =
      PadTouches(stairs, PadFromRight({0.01605, -0.0059, 0.0}, 0.006, 0.005), 8, nullptr, true);
  int at_side = 0, on_floor = 0;
  for (const SurfaceContact& contact : contacts) {
    if (contact.distance < 0.0) {
      ++at_side;
      EXPECT_NEAR(contact.distance, -0.0001, 1e-9);
      EXPECT_LT((contact.normal + Vector3d::UnitY()).norm(), 1e-9);
      EXPECT_NEAR(contact.position.y(), 0.00005, 1e-9);
      EXPECT_NEAR(contact.position.x(), 0.5 * (0.01605 + 0.02), 1e-9);
      EXPECT_NEAR(std::abs(contact.position.z()), 0.005, 1e-9);
    } else {
      ++on_floor;
      EXPECT_NEAR(contact.distance, 0.00005, 1e-9);
      EXPECT_LT((contact.normal - Vector3d::UnitX()).norm(), 1e-9);
    }
  }
  EXPECT_EQ(at_side, 2);
  EXPECT_GE(on_floor, 4);
}

TEST(PadContact, HasTheSameBitsWithACache) {
  const ContactSolid solid(shapes::Bumpy(0.02, 4, 6));
  RngStream rng(4, "test");
  TouchCache cache;
  PadPose pad = PadFromRight({0.0208, 0.0, 0.0}, 0.004, 0.006);
  int contacts_seen = 0;
  for (int i = 0; i < 1000; ++i) {
    pad.center += DrawPoint(0.02e-3, &rng);
    pad.axes = AngleAxisd(0.002 * rng.Normal(), DrawDirection(&rng)).toRotationMatrix() * pad.axes;
    const auto plain = PadTouches(solid, pad);
    const auto cached = PadTouches(solid, pad, 8, &cache);
    ASSERT_EQ(cached.size(), plain.size());
    ASSERT_EQ(std::memcmp(cached.data(), plain.data(), plain.size() * sizeof(SurfaceContact)), 0);
    contacts_seen += static_cast<int>(plain.size());
  }
  EXPECT_GT(contacts_seen, 1000);
}

TEST(PadDistance, IsTheGapFlatOnAndNeverMoreThanIt) {
  const double inf = std::numeric_limits<double>::infinity();
  const ContactSolid cube(shapes::Box({0.04, 0.04, 0.04}));
  const PadPose flat = PadFromRight({0.023, 0.003, 0.0}, 0.01, 0.006);
  EXPECT_NEAR(cube.Distance(flat, 0.1), 0.003, 1e-15);
  EXPECT_EQ(cube.Distance(flat, 0.0029), inf);
  // Edge along edge, 3 and 4 mm apart: not 5 mm, but the larger gap of the two.
  EXPECT_NEAR(cube.Distance(PadFromRight({0.023, 0.034, 0.0}, 0.01, 0.006), 0.1), 0.004, 1e-15);
  EXPECT_EQ(cube.Distance(PadFromRight({0.0199, 0.0, 0.0}, 0.01, 0.006), 0.1), 0.0);
  EXPECT_EQ(cube.Distance(PadFromRight({-0.004, 0.0, 0.0}, 0.001, 0.001), 0.0), 0.0);  // inside
  // Against the corners of a bumpy solid.
  const TriangleMesh mesh = shapes::Bumpy(0.02, 3, 6);
  const ContactSolid bumpy(mesh);
  RngStream rng(5, "test");
  for (int i = 0; i < 50; ++i) {
    PadPose pad{0.035 * DrawDirection(&rng), DrawRotation(&rng), {0.004, 0.007, 0.005}};
    const double bound = bumpy.Distance(pad, 1.0);
    double sampled = inf;
    for (const Vector3d& v : mesh.vertices) {
      const Vector3d local = pad.axes.transpose() * (v - pad.center);
      sampled = std::min(sampled, (local.cwiseAbs() - pad.half).cwiseMax(0.0).norm());
    }
    EXPECT_LE(bound, sampled);
    EXPECT_GE(bound, 0.7 * sampled);
  }
}

TEST(PadDistance, NoticesWhatOverlaps) {
  const ContactSolid cube(shapes::Box({0.04, 0.04, 0.04}));
  EXPECT_FALSE(cube.Overlaps(PadFromRight({0.0201, 0.0, 0.0}, 0.01, 0.006)));
  EXPECT_TRUE(cube.Overlaps(PadFromRight({0.0199, 0.0, 0.0}, 0.01, 0.006)));
  EXPECT_TRUE(cube.Overlaps(PadFromRight({0.0, 0.0, 0.0}, 0.001, 0.001)));      // all inside
  EXPECT_TRUE(cube.Overlaps(PadFromRight({0.018, 0.0, 0.029}, 0.01, 0.01)));    // its side
  EXPECT_FALSE(cube.Overlaps(PadFromRight({0.018, 0.0, 0.0301}, 0.01, 0.01)));  // beside
}

}  // namespace
}  // namespace antigrasp
