#include "antigrasp/quality/antipodal_sampler.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
constexpr double kOpening = 0.05;
constexpr double kFriction = 0.5;

struct Sampled {
  std::vector<Grasp> grasps;
  int attempts;
};

Sampled SampleGrasps(const TriangleMesh& mesh, int attempts) {
  const RayScene scene(mesh);
  const AntipodalSampler sampler(mesh, scene, kFriction, kOpening);
  Sampled sampled{{}, attempts};
  for (int i = 0; i < attempts; ++i) {
    RngStream rng(1, "grasp", 0, static_cast<std::uint64_t>(i));
    if (const auto grasp = sampler.Try(&rng)) sampled.grasps.push_back(*grasp);
  }
  return sampled;
}

void ExpectAntipodal(const Grasp& grasp) {
  const auto& [first, second] = grasp.contacts;
  EXPECT_NEAR(grasp.axis.norm(), 1.0, 1e-14);
  EXPECT_LE(grasp.width, kOpening);
  EXPECT_NEAR((second.point - first.point - grasp.width * grasp.axis).norm(), 0.0, 1e-9);
  EXPECT_NEAR((0.5 * (first.point + second.point) - grasp.center).norm(), 0.0, 1e-9);
  EXPECT_FALSE(Slips(-first.normal, grasp.axis, kFriction));
  EXPECT_FALSE(Slips(-second.normal, -grasp.axis, kFriction));
  EXPECT_NEAR(first.normal_force, grasp.axis.dot(-first.normal), 1e-14);
  EXPECT_NEAR(second.normal_force, grasp.axis.dot(second.normal), 1e-14);
}

TEST(SurfaceSampler, VisitsFacesInProportionToTheirArea) {
  const TriangleMesh box = shapes::Box({1.0, 2.0, 4.0});
  const SurfaceSampler sampler(box);
  EXPECT_NEAR(sampler.area(), 28.0, 1e-12);
  RngStream rng(1, "surface");
  const int count = 40000;
  Eigen::Vector3d share = Vector3d::Zero();  // by the direction of the normal
  Eigen::Vector3d mean = Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const auto [point, normal, face] = sampler.Draw(&rng);
    share += normal.cwiseAbs() / count;
    mean += point / count;
    EXPECT_NEAR((point.cwiseAbs() - Vector3d(0.5, 1.0, 2.0)).maxCoeff(), 0.0, 1e-14);
  }
  EXPECT_NEAR(share.x(), 16.0 / 28.0, 0.01);
  EXPECT_NEAR(share.y(), 8.0 / 28.0, 0.01);
  EXPECT_NEAR(share.z(), 4.0 / 28.0, 0.01);
  EXPECT_LT(mean.norm(), 0.04);
}

TEST(SurfaceSampler, NeverVisitsAFaceWithoutArea) {
  TriangleMesh mesh = shapes::Tetrahedron();
  mesh.faces.insert(mesh.faces.begin(), {0, 0, 1});
  mesh.faces.push_back({2, 2, 2});
  const SurfaceSampler sampler(mesh);
  RngStream rng(2, "surface");
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(sampler.Draw(&rng).normal.norm(), 1.0, 1e-14);
}

TEST(SurfaceSampler, IsUniformWithinEachTriangle) {
  // A right triangle with legs 1 and 2: centroid (1/3, 2/3), E[x^2] = 1/6, E[xy] = 2/12.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  mesh.faces = {{0, 1, 2}};
  const SurfaceSampler sampler(mesh);
  EXPECT_DOUBLE_EQ(sampler.area(), 1.0);
  RngStream rng(5, "surface");
  const int count = 20000;
  Vector3d mean = Vector3d::Zero();
  double xx = 0.0, xy = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto [p, normal, face] = sampler.Draw(&rng);
    EXPECT_EQ(normal, Vector3d::UnitZ());
    EXPECT_GE(p.minCoeff(), 0.0);
    EXPECT_LE(p.x() + 0.5 * p.y(), 1.0 + 1e-15);
    mean += p / count;
    xx += p.x() * p.x() / count;
    xy += p.x() * p.y() / count;
  }
  EXPECT_NEAR(mean.x(), 1.0 / 3.0, 0.006);
  EXPECT_NEAR(mean.y(), 2.0 / 3.0, 0.012);
  EXPECT_NEAR(xx, 1.0 / 6.0, 0.005);
  EXPECT_NEAR(xy, 1.0 / 6.0, 0.005);
}

TEST(DrawInCone, TakesTheHeightFromTheFirstNumberAndTheTurnFromTheSecond) {
  const Vector3d axis = Vector3d(-2.0, 1.0, 3.0).normalized();
  for (std::uint64_t i = 0; i < 20; ++i) {
    RngStream rng(4, "cone", i), plain(4, "cone", i);
    const Vector3d u = DrawInCone(axis, 0.8, &rng);
    EXPECT_NEAR(u.dot(axis), 1.0 - plain.Uniform() * (1.0 - std::cos(0.8)), 1e-15);
    const Vector3d side = axis.unitOrthogonal();
    const double turn = std::atan2(u.dot(axis.cross(side)), u.dot(side));
    const double expected = 2.0 * std::numbers::pi * plain.Uniform();
    EXPECT_NEAR(std::remainder(turn - expected, 2.0 * std::numbers::pi), 0.0, 1e-13);
    EXPECT_EQ(rng.Uniform(), plain.Uniform());
  }
}

TEST(DrawInCone, IsUniformOverTheSolidAngle) {
  RngStream rng(3, "cone");
  const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
  const double half_angle = std::atan(0.5);
  const double edge = std::cos(half_angle);
  const int count = 40000;
  double mean_height = 0.0;
  Vector3d mean = Vector3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Vector3d u = DrawInCone(axis, half_angle, &rng);
    EXPECT_NEAR(u.norm(), 1.0, 1e-14);
    EXPECT_GE(u.dot(axis), edge - 1e-14);
    mean_height += u.dot(axis) / count;
    mean += u / count;
  }
  EXPECT_NEAR(mean_height, 0.5 * (1.0 + edge), 3e-4);  // height is uniform in [cos, 1]
  EXPECT_LT((mean - mean.dot(axis) * axis).norm(), 5e-3);
}

TEST(AntipodalSampler, EveryGraspOfASphereIsAntipodalAndOnTheSurface) {
  const Sampled sampled = SampleGrasps(shapes::Sphere(0.02, 4), 1000);
  EXPECT_GT(sampled.grasps.size(), 900u);  // a chord through a sphere meets both ends alike
  for (const Grasp& grasp : sampled.grasps) {
    ExpectAntipodal(grasp);
    for (const Contact& c : grasp.contacts) {
      EXPECT_NEAR(c.point.norm(), 0.02, 1e-4);
      EXPECT_GT(c.normal.dot(c.point), 0.0);
    }
  }
}

TEST(AntipodalSampler, ClosesAlongADirectionOfTheFrictionConeAboutTheInwardNormal) {
  // The cone's half angle is atan(mu), not mu: 0.46 and 0.5 rad here, 1.0 and 1.6 rad below.
  const TriangleMesh box = shapes::Box({0.03, 0.06, 0.08});
  const RayScene scene(box);
  for (const double friction : {0.5, 1.6}) {
    const AntipodalSampler sampler(box, scene, friction, kOpening);
    int found = 0;
    for (std::uint64_t i = 0; i < 300; ++i) {
      RngStream rng(6, "grasp", i), again(6, "grasp", i);
      const auto grasp = sampler.Try(&rng);
      const auto [point, normal, face] = SurfaceSampler(box).Draw(&again);
      const Vector3d axis = DrawInCone(-normal, std::atan(friction), &again);
      if (!grasp) continue;
      ++found;
      EXPECT_EQ(grasp->axis, axis);
      EXPECT_LT((grasp->contacts[0].point - point).norm(), 1e-9);
      EXPECT_EQ(grasp->contacts[0].normal, normal);
      const Vector3d across = grasp->contacts[1].point - point;
      EXPECT_LT((across - grasp->width * axis).norm(), 1e-9);
      if (friction > 1.0) continue;  // else it may close on two sides of an edge
      EXPECT_EQ(grasp->contacts[1].normal, -normal);
      EXPECT_NEAR(grasp->width, 0.03 / std::abs(axis.x()), 1e-9);
    }
    EXPECT_GT(found, 30);
  }
}

TEST(AntipodalSampler, GraspsABoxOnlyAcrossSidesNarrowerThanTheOpening) {
  const Sampled sampled = SampleGrasps(shapes::Box({0.04, 0.06, 0.08}), 2000);
  EXPECT_GT(sampled.grasps.size(), 200u);
  for (const Grasp& grasp : sampled.grasps) {
    ExpectAntipodal(grasp);
    EXPECT_GT(std::abs(grasp.contacts[0].normal.x()), 0.99);
    EXPECT_GT(std::abs(grasp.axis.x()), 0.8);
  }
}

TEST(AntipodalSampler, FindsNothingOnAnObjectWiderThanTheOpening) {
  EXPECT_TRUE(SampleGrasps(shapes::Sphere(0.05, 3), 1000).grasps.empty());
}

TEST(AntipodalSampler, JawsCannotReachIntoANarrowSlot) {
  // Two plates 4 mm apart: the inner sides face each other across the gap, outward normals towards
  // it, and a jaw on its way there meets the other plate first.
  const TriangleMesh plate = shapes::Box({0.01, 0.04, 0.04});
  const Vector3d x = Vector3d::UnitX();
  const Sampled sampled = SampleGrasps(
      shapes::Joined(Transformed(plate, 1.0, -0.007 * x), Transformed(plate, 1.0, 0.007 * x)),
      4000);
  EXPECT_GT(sampled.grasps.size(), 100u);
  for (const Grasp& grasp : sampled.grasps) {
    ExpectAntipodal(grasp);
    for (const Contact& contact : grasp.contacts) {
      // Near the rim a tilted jaw slips past the other plate, further in it cannot.
      const Vector3d at = contact.point.cwiseAbs();
      const bool inner_side = std::abs(contact.normal.x()) > 0.9 &&
                              std::abs(at.x() - 0.002) < 1e-6 && std::max(at.y(), at.z()) < 0.0175;
      EXPECT_FALSE(inner_side);
    }
  }
}

// How many of 1000 candidates are no grasp for each reason, in the order of GraspRejection.
std::array<int, 3> Reasons(const TriangleMesh& mesh) {
  const RayScene scene(mesh);
  const AntipodalSampler sampler(mesh, scene, kFriction, kOpening);
  std::array<int, 3> counts{};
  for (std::uint64_t i = 0; i < 1000; ++i) {
    RngStream rng(1, "grasp", 0, i);
    GraspRejection why{};
    if (!sampler.Try(&rng, &why)) ++counts[static_cast<std::size_t>(why)];
  }
  return counts;
}

TEST(AntipodalSampler, AnOppositeSeenFromItsInsideIsNone) {
  // Two squares that both face up, 3 cm apart: from the upper one a jaw coming back sees the lower
  // one's back; from the lower one there is nothing.
  const TriangleMesh square = Transformed(shapes::FlatSquare(), 0.5, Vector3d::Zero());
  const TriangleMesh both =
      shapes::Joined(square, Transformed(square, 1.0, -0.03 * Vector3d::UnitZ()));
  EXPECT_EQ(Reasons(both), (std::array{1000, 0, 0}));
  EXPECT_EQ(Reasons(shapes::Inverted(shapes::Box({0.03, 0.03, 0.03}))), (std::array{1000, 0, 0}));
}

TEST(AntipodalSampler, ACandidateBetweenTwoShieldsIsBlockedAndOneOnAWedgeSlips) {
  // A plate with a thin sheet before each side, all of 2 m so that no edge is near. From the plate
  // a jaw meets a sheet first: blocked. So does the first jaw from a sheet's inner side; the outer
  // sides of the sheets, a third of all, are 2 cm apart and make grasps.
  const Vector3d x = Vector3d::UnitX();
  const auto slab = [&](double thick, double at) {
    return Transformed(shapes::Box({thick, 2.0, 2.0}), 1.0, at * x);
  };
  const auto shielded = Reasons(
      shapes::Joined(slab(0.01, 0.0), shapes::Joined(slab(0.001, 0.0095), slab(0.001, -0.0095))));
  EXPECT_LT(shielded[0] + shielded[1], 20) << "but for the rim";
  EXPECT_NEAR(shielded[2], 667, 60);
  // Sides that lean to each other by 2 x 27.5 degrees, more than 2 atan(0.5) = 53.1: all slip.
  TriangleMesh wedge = shapes::Box({0.02, 2.0, 0.02});
  for (Vector3d& v : wedge.vertices) {
    v.x() -= std::copysign(std::tan(27.5 / 180.0 * std::numbers::pi), v.x()) * v.z();
  }
  const auto leaning = Reasons(wedge);
  EXPECT_GT(leaning[1], 300);
  EXPECT_EQ(leaning[2], 0);
}

TEST(AntipodalSampler, SaysWhyACandidateIsNoGrasp) {
  const auto reasons = Reasons;
  const auto index = [](GraspRejection why) { return static_cast<std::size_t>(why); };
  // Wider than the opening; faces at 70.5 degrees; a plate whose other side is 4 mm from a block.
  EXPECT_EQ(reasons(shapes::Sphere(0.05, 3))[index(GraspRejection::kNoOpposite)], 1000);
  const auto slips = reasons(Transformed(shapes::Tetrahedron(), 0.04, Vector3d::Zero()));
  EXPECT_GT(slips[index(GraspRejection::kSlips)], 500);
  const TriangleMesh plate = shapes::Box({0.01, 0.04, 0.04});
  const auto blocked =
      reasons(shapes::Joined(plate, Transformed(plate, 1.0, 0.014 * Vector3d::UnitX())));
  EXPECT_GT(blocked[index(GraspRejection::kJawBlocked)], 100);
}

TEST(AntipodalSampler, InvertedAndOpenMeshesGiveNoGraspsInsteadOfACrash) {
  EXPECT_TRUE(SampleGrasps(shapes::Inverted(shapes::Sphere(0.02, 3)), 500).grasps.empty());
  EXPECT_TRUE(
      SampleGrasps(Transformed(shapes::FlatSquare(), 0.04, Vector3d::Zero()), 500).grasps.empty());
}

TEST(AntipodalSampler, UsesTheSameAmountOfRandomnessWhateverTheOutcome) {
  const TriangleMesh box = shapes::Box({0.04, 0.06, 0.08});
  const RayScene scene(box);
  const AntipodalSampler sampler(box, scene, kFriction, kOpening);
  for (std::uint64_t i = 0; i < 50; ++i) {
    RngStream used(4, "grasp", i), plain(4, "grasp", i);
    sampler.Try(&used);
    for (int k = 0; k < 5; ++k) plain.Uniform();
    EXPECT_EQ(used.Uniform(), plain.Uniform());
  }
}

}  // namespace
}  // namespace antigrasp
