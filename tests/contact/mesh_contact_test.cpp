#include "antigrasp/contact/mesh_contact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/contact_shapes.h"
#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kTouchMargin = 0.2e-3;

std::vector<SurfaceContact> Touches(const ContactSolid& solid, const SpherePose& sphere,
                                    double margin = kTouchMargin, int most = 4,
                                    TouchCache* cache = nullptr) {
  std::vector<SurfaceContact> contacts(static_cast<std::size_t>(most));
  contacts.resize(solid.Touch(sphere, margin, contacts.data(), most, cache));
  return contacts;
}

void ExpectContact(const SurfaceContact& contact, const Vector3d& position, const Vector3d& normal,
                   double distance) {
  EXPECT_LT((contact.position - position).norm(), 1e-12) << contact.position.transpose();
  EXPECT_LT((contact.normal - normal).norm(), 1e-9) << contact.normal.transpose();
  EXPECT_NEAR(contact.distance, distance, 1e-12);
}

// 40 x 30 x 20 mm.
TriangleMesh Block() { return shapes::Box({0.04, 0.03, 0.02}); }

// Legs along x and y, 20 mm long and 10 mm thick, around a notch with its corner at (10, 10) mm.
TriangleMesh LShape() {
  return Transformed(shapes::Extruded({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                                      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}, 4.0),
                     0.01, Vector3d::Zero());
}

// 30 mm wide and 20 mm high with a slot of 10 mm in the middle of the top, 10 mm deep.
TriangleMesh UShape() {
  return Transformed(
      shapes::Extruded({{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                       {{0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 7}, {5, 6, 7}}, 4.0),
      0.01, Vector3d::Zero());
}

// A block whose top is a valley along z with this angle between the normals of its sides.
TriangleMesh Valley(double degrees) {
  const double rise = 0.02 * std::tan(0.5 * degrees * std::numbers::pi / 180.0);
  return shapes::Extruded({{-0.02, -0.01}, {0.02, -0.01}, {0.02, rise}, {0.0, 0.0}, {-0.02, rise}},
                          {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}}, 0.04);
}

TEST(SphereContact, OnAFaceIsOnePointUnderTheCentreAlsoOnTheFacesDiagonal) {
  const ContactSolid solid(Block());
  for (const double y : {0.003, 0.0}) {
    const auto contacts = Touches(solid, {{0.0249, y, 0.0}, 0.005});
    ASSERT_EQ(contacts.size(), 1U);
    ExpectContact(contacts[0], {0.01995, y, 0.0}, Vector3d::UnitX(), -0.0001);
  }
}

TEST(SphereContact, OnAnEdgeAndAtACornerPointsFromThereToTheCentre) {
  const ContactSolid solid(Block());
  const Vector3d over_edge = Vector3d(1.0, 1.0, 0.0).normalized();
  const auto edge = Touches(solid, {Vector3d(0.02, 0.015, 0.004) + 0.0051 * over_edge, 0.005});
  ASSERT_EQ(edge.size(), 1U);
  ExpectContact(edge[0], Vector3d(0.02, 0.015, 0.004) + 0.00005 * over_edge, over_edge, 0.0001);
  const Vector3d over_corner = Vector3d(-1.0, 2.0, -2.0) / 3.0;
  const auto corner = Touches(solid, {Vector3d(-0.02, 0.015, -0.01) + 0.005 * over_corner, 0.005});
  ASSERT_EQ(corner.size(), 1U);
  ExpectContact(corner[0], {-0.02, 0.015, -0.01}, over_corner, 0.0);
}

TEST(SphereContact, EndsAtTheMargin) {
  const ContactSolid solid(Block());
  EXPECT_EQ(Touches(solid, {{0.0, 0.0, 0.015199}, 0.005}).size(), 1U);
  EXPECT_EQ(Touches(solid, {{0.0, 0.0, 0.015201}, 0.005}).size(), 0U);
}

TEST(SphereContact, InANotchIsWithBothWallsTheNearerOneFirst) {
  const auto contacts = Touches(ContactSolid(LShape()), {{0.0149, 0.0148, 0.001}, 0.005});
  ASSERT_EQ(contacts.size(), 2U);
  ExpectContact(contacts[0], {0.0149, 0.0099, 0.001}, Vector3d::UnitY(), -0.0002);
  ExpectContact(contacts[1], {0.00995, 0.0148, 0.001}, Vector3d::UnitX(), -0.0001);
}

TEST(SphereContact, InTheSlotOfAUMeetsItsWallsAndNotTheHull) {
  const ContactSolid solid(UShape());
  EXPECT_TRUE(Touches(solid, {{0.015, 0.016, 0.0}, 0.0047}).empty());
  EXPECT_FALSE(solid.Overlaps(SpherePose{{0.015, 0.016, 0.0}, 0.0047}));
  const auto walls = Touches(solid, {{0.015, 0.0160, 0.0}, 0.0049});
  ASSERT_EQ(walls.size(), 2U);
  EXPECT_NEAR(walls[0].normal.dot(walls[1].normal), -1.0, 1e-12);
  EXPECT_NEAR(walls[0].distance, 0.0001, 1e-12);
  EXPECT_EQ(Touches(solid, {{0.015, 0.0149, 0.0}, 0.0049}).size(), 3U);  // and the floor
}

TEST(SphereContact, OfNormalsNearerThanEightDegreesKeepsOne) {
  for (const double degrees : {7.0, 9.0}) {
    const double half = 0.5 * degrees * std::numbers::pi / 180.0;
    const SpherePose sphere{{0.0, 0.0049 / std::cos(half), 0.0}, 0.005};
    const auto contacts = Touches(ContactSolid(Valley(degrees)), sphere);
    ASSERT_EQ(contacts.size(), degrees < 8.0 ? 1U : 2U);
    for (const SurfaceContact& contact : contacts) {
      EXPECT_NEAR(contact.distance, -0.0001, 1e-12);
      EXPECT_NEAR(contact.normal.y(), std::cos(half), 1e-12);
    }
  }
}

TEST(SphereContact, OnASphereOfTrianglesLooksAwayFromItsCentre) {
  const double radius = 0.02;
  const ContactSolid solid(shapes::Sphere(radius, 4));
  RngStream rng(1, "test");
  for (int i = 0; i < 50; ++i) {
    const Vector3d direction = DrawDirection(&rng);
    const auto contacts = Touches(solid, {0.025 * direction, 0.005});
    ASSERT_EQ(contacts.size(), 1U);
    // Facets of up to 1.6 mm lie up to 21 um inside and up to 2.6 degrees from the sphere.
    EXPECT_GE(contacts[0].distance, -1e-12);
    EXPECT_LT(contacts[0].distance, 22e-6);
    EXPECT_GT(contacts[0].normal.dot(direction), std::cos(2.7 * std::numbers::pi / 180.0));
  }
}

TEST(SphereContact, DoesNotReachThroughAThinWall) {
  // A blade of 12 degrees with its edge along z: the foot on its other side is 5.14 mm away and in
  // a direction of its own.
  const double thick = 0.03 * std::tan(12.0 * std::numbers::pi / 180.0);
  const ContactSolid blade(
      shapes::Extruded({{0.0, 0.0}, {0.03, -thick}, {0.03, 0.0}}, {{0, 1, 2}}, 0.04));
  const auto contacts = Touches(blade, {{0.0012, 0.00498, 0.001}, 0.005});
  ASSERT_EQ(contacts.size(), 1U);
  ExpectContact(contacts[0], {0.0012, -0.00001, 0.001}, Vector3d::UnitY(), -0.00002);
}

TEST(SphereContact, WithItsCentreInsidePointsOut) {
  const auto contacts = Touches(ContactSolid(Block()), {{0.001, 0.002, 0.009}, 0.005});
  ASSERT_EQ(contacts.size(), 1U);
  ExpectContact(contacts[0], {0.001, 0.002, 0.007}, Vector3d::UnitZ(), -0.006);
  const auto on_surface = Touches(ContactSolid(Block()), {{0.001, 0.002, 0.01}, 0.005});
  ASSERT_EQ(on_surface.size(), 1U);
  ExpectContact(on_surface[0], {0.001, 0.002, 0.0075}, Vector3d::UnitZ(), -0.005);
}

// --- Against every triangle -----------------------------------------------------------------

Vector3d NearestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p) {
  const double share = (p - a).dot(b - a) / (b - a).squaredNorm();
  return a + std::clamp(share, 0.0, 1.0) * (b - a);
}

// The foot of the perpendicular if it is inside, else the nearest of three segments.
Vector3d NearestOnTriangle(const std::array<Vector3d, 3>& t, const Vector3d& p) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  const Vector3d foot = p - normal.dot(p - t[0]) * normal;
  bool inside = true;
  Vector3d best = t[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = t[k];
    const Vector3d& b = t[(k + 1) % 3];
    if (normal.dot((b - a).cross(foot - a)) < 0.0) inside = false;
    const Vector3d near = NearestOnSegment(a, b, p);
    if ((near - p).norm() < (best - p).norm()) best = near;
  }
  return inside ? foot : best;
}

// What Touch() promises, from the definition, for a centre outside.
std::vector<Vector3d> PlainMinima(const TriangleMesh& mesh, const SpherePose& sphere,
                                  double reach) {
  std::vector<Vector3d> near;
  for (const auto& face : mesh.faces) {
    near.push_back(NearestOnTriangle(
        {mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]}, sphere.center));
  }
  const auto distance = [&](const Vector3d& p) { return (p - sphere.center).norm(); };
  std::vector<Vector3d> minima;
  for (const Vector3d& point : near) {
    bool lowest = distance(point) <= reach;
    bool seen_from_outside = false;
    for (std::size_t f = 0; lowest && f < mesh.faces.size(); ++f) {
      const auto& face = mesh.faces[f];
      const Vector3d again = NearestOnTriangle(
          {mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]}, point);
      if ((again - point).norm() > 1e-11) continue;
      lowest = distance(near[f]) > distance(point) - 1e-12;
      seen_from_outside |= FaceCross(mesh, f).dot(sphere.center - point) > 0.0;
    }
    if (lowest && seen_from_outside) minima.push_back(point);
  }
  std::sort(minima.begin(), minima.end(),
            [&](const Vector3d& a, const Vector3d& b) { return distance(a) < distance(b); });
  std::vector<Vector3d> apart;
  for (const Vector3d& point : minima) {
    const Vector3d direction = (sphere.center - point).normalized();
    const bool seen = std::any_of(apart.begin(), apart.end(), [&](const Vector3d& other) {
      return (sphere.center - other).normalized().dot(direction) >
             std::cos(8.0 * std::numbers::pi / 180.0);
    });
    if (!seen && apart.size() < 4) apart.push_back(point);
  }
  return apart;
}

TEST(SphereContact, IsWhatAllTrianglesOfABumpySolidSay) {
  const TriangleMesh mesh = shapes::Bumpy(0.02, 3, 5);
  const ContactSolid solid(mesh);
  RngStream rng(2, "test");
  int several = 0;
  for (int i = 0; i < 200; ++i) {
    SpherePose sphere{0.05 * DrawDirection(&rng), 0.005};
    // Pushed in until it is 0.3 mm deep: hills and dents then both touch.
    const Vector3d in = -sphere.center.normalized();
    for (int step = 0; step < 60; ++step) {
      sphere.center += std::max(0.0, solid.Distance(sphere, kUnlimited) + 0.05e-3) * in;
    }
    sphere.center += 0.25e-3 * in;
    const auto expected = PlainMinima(mesh, sphere, sphere.radius + kTouchMargin);
    const auto contacts = Touches(solid, sphere);
    ASSERT_EQ(contacts.size(), expected.size()) << i;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      const Vector3d out = sphere.center - expected[k];
      ExpectContact(contacts[k], 0.5 * (expected[k] + sphere.center - 0.005 * out.normalized()),
                    out.normalized(), out.norm() - 0.005);
    }
    several += contacts.size() > 1;
  }
  EXPECT_GT(several, 50);
}

TEST(SphereContact, HasTheSameBitsWithACacheAndOnACopyOfTheSolid) {
  const TriangleMesh mesh = shapes::Bumpy(0.02, 4, 5);
  const ContactSolid solid(mesh);
  const ContactSolid copy(mesh);
  RngStream rng(3, "test");
  TouchCache cache;
  SpherePose sphere{{0.0, 0.0, 0.0235}, 0.005};
  int contacts_seen = 0;
  for (int i = 0; i < 2000; ++i) {
    sphere.center += DrawPoint(0.05e-3, &rng);
    sphere.center *= 0.0235 / sphere.center.norm();
    const auto plain = Touches(solid, sphere);
    const auto cached = Touches(copy, sphere, kTouchMargin, 4, &cache);
    ASSERT_EQ(cached.size(), plain.size());
    ASSERT_EQ(std::memcmp(cached.data(), plain.data(), plain.size() * sizeof(SurfaceContact)), 0);
    contacts_seen += static_cast<int>(plain.size());
  }
  EXPECT_GT(contacts_seen, 1000);
}

// --- Distance, overlap, table -----------------------------------------------------------------

TEST(ContactSolid, MeasuresTheGapToASphereAndItsDepth) {
  const ContactSolid solid(Block());
  EXPECT_NEAR(solid.Distance(SpherePose{{0.0, 0.0, 0.1}, 0.005}, 1.0), 0.085, 1e-15);
  EXPECT_NEAR(solid.Distance(SpherePose{{0.023, 0.019, 0.0}, 0.002}, 1.0), 0.003, 1e-15);
  EXPECT_EQ(solid.Distance(SpherePose{{0.0, 0.0, 0.1}, 0.005}, 0.0849), kUnlimited);
  EXPECT_NEAR(solid.Distance(SpherePose{{0.0, 0.0, 0.013}, 0.005}, 0.0), -0.002, 1e-15);
  // Inside, farther from the surface than the limit reaches: 9 mm and the radius deep.
  EXPECT_NEAR(solid.Distance(SpherePose{{0.0, 0.0, 0.001}, 0.002}, 0.0), -0.011, 1e-15);
}

TEST(ContactSolid, OverlapsASphereThatMeetsItsSurfaceOrIsInside) {
  const ContactSolid solid(Block());
  EXPECT_TRUE(solid.Overlaps(SpherePose{{0.0, 0.0, 0.0149}, 0.005}));
  EXPECT_FALSE(solid.Overlaps(SpherePose{{0.0, 0.0, 0.0151}, 0.005}));
  EXPECT_TRUE(solid.Overlaps(SpherePose{{0.0, 0.0, 0.001}, 0.002}));
}

TEST(ContactSolid, HasNoMatterInAVoid) {
  const TriangleMesh void_inside = shapes::Inverted(shapes::Box({0.02, 0.02, 0.02}));
  const ContactSolid hollow(shapes::Joined(shapes::Box({0.04, 0.04, 0.04}), void_inside));
  EXPECT_FALSE(hollow.Overlaps(SpherePose{{0.001, 0.0, 0.0}, 0.002}));
  EXPECT_TRUE(hollow.Overlaps(SpherePose{{0.015, 0.0, 0.0}, 0.002}));
}

TEST(TableContact, UnderABlockIsAtItsFourCornersAndPointsUp) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.4, Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  const ContactSolid solid(shapes::Rotated(shapes::Subdivided(Block(), 2), turn));
  const Vector3d up = turn.col(2);
  std::array<SurfaceContact, 6> contacts;
  ASSERT_EQ(solid.TouchPlane(up, -0.00998, kTouchMargin, contacts.data()), 4);
  double area = 0.0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(contacts[i].distance, -0.00002, 1e-12);
    EXPECT_LT((contacts[i].normal - up).norm(), 1e-15);
    const Vector3d place = turn.transpose() * contacts[i].position;
    EXPECT_NEAR(std::abs(place.x()), 0.02, 1e-12);
    EXPECT_NEAR(std::abs(place.y()), 0.015, 1e-12);
    EXPECT_NEAR(place.z(), -0.00999, 1e-12);
    area += place.x() * place.y() * (place.x() * place.y() > 0.0 ? 1.0 : -1.0);
  }
  EXPECT_NEAR(area, 4 * 0.02 * 0.015, 1e-12);  // no corner twice
  EXPECT_EQ(solid.TouchPlane(up, -0.0103, kTouchMargin, contacts.data()), 0);
}

TEST(TableContact, UnderATetrahedronIsAtThreeCornersAndOnItsEdgeAtTwo) {
  const ContactSolid solid(Transformed(shapes::Tetrahedron(), 0.03, Vector3d::Zero()));
  std::array<SurfaceContact, 6> contacts;
  EXPECT_EQ(solid.TouchPlane(Vector3d::UnitZ(), 0.0, kTouchMargin, contacts.data()), 3);
  EXPECT_EQ(
      solid.TouchPlane(Vector3d(0.0, 1.0, 1.0).normalized(), 0.0, kTouchMargin, contacts.data()),
      2);
}

TEST(TableContact, UnderARoundCapKeepsItsExtentWithFewPoints) {
  const ContactSolid solid(shapes::Cylinder(0.02, 0.05, 60));
  std::array<SurfaceContact, 6> contacts;
  ASSERT_EQ(solid.TouchPlane(Vector3d::UnitZ(), -0.025, kTouchMargin, contacts.data()), 6);
  Vector3d mean = Vector3d::Zero();
  for (const SurfaceContact& contact : contacts) {
    EXPECT_NEAR(contact.position.head<2>().norm(), 0.02, 1e-12);
    mean += contact.position / 6.0;
  }
  EXPECT_LT(mean.head<2>().norm(), 0.005);  // all around
}

}  // namespace
}  // namespace antigrasp
