#include "antigrasp/perturb/antipodal_rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/perturb/decimate.h"
#include "antigrasp/perturb/mesh_change.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

PerturbResult Rotated(const TriangleMesh& mesh, const RotationOptions& options,
                      const PerturbOptions& common = {}, std::uint64_t seed = 1) {
  RngStream rng(seed, "perturb");
  return PerturbByRotation(mesh, PairLimitsOf(common, 0.5, 1.0), common, options, &rng);
}

TEST(RotationAxis, IsOrthogonalToBothNormalsAndDefinedWhenTheyAreParallel) {
  const auto shape = [](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return FaceShape(a, b, c);
  };
  const FaceShape down = shape({0, 0, 0}, {0, 1, 0}, {2, 0, 0});
  const FaceShape tilted = shape({0, 0, 1}, {1, 0, 1.1}, {0, 1, 1.3});
  const Vector3d axis = RotationAxis(down, tilted);
  EXPECT_NEAR(axis.norm(), 1.0, 1e-15);
  EXPECT_NEAR(axis.dot(down.normal), 0.0, 1e-15);
  EXPECT_NEAR(axis.dot(tilted.normal), 0.0, 1e-15);
  // Parallel, sideways: across the line between the centroids.
  const FaceShape beside = shape({5, 0, 1}, {7, 0, 1}, {5, 1, 1});
  ASSERT_EQ(beside.normal, Vector3d::UnitZ());
  EXPECT_NEAR(std::abs(RotationAxis(down, beside).y()), 1.0, 1e-15);
  // Parallel, one above the other: along the longest edge of the first face, (0, 1) to (2, 0).
  const FaceShape above = shape({0, 0, 1}, {2, 0, 1}, {0, 1, 1});
  EXPECT_NEAR(std::abs(RotationAxis(down, above).dot(Vector3d(2, -1, 0).normalized())), 1.0, 1e-15);
}

TEST(RotateFaces, RaisesTheAngleByTwiceThetaAboutTheCentroids) {
  const double psi = std::atan(0.5);
  const EditableMesh mesh(shapes::Sphere(1.0, 2));
  int looked_at = 0;
  for (const FacePair& pair : AntipodalPairs(mesh.mesh(), {psi})) {
    const FaceShape first = mesh.Shape(pair.first), second = mesh.Shape(pair.second);
    const double phi = AntipodalityAngle(first.normal, second.normal);
    if (phi >= psi || phi < 1e-6 || ++looked_at > 200) continue;
    const double theta = 0.3 * (psi - phi);
    TriangleMesh moved = mesh.mesh();
    for (const VertexMove& move :
         RotateFaces(mesh, pair.first, pair.second, RotationAxis(first, second), theta)) {
      moved.vertices[move.vertex] = move.to;
    }
    const FaceShape a(moved, pair.first), b(moved, pair.second);
    EXPECT_NEAR(AntipodalityAngle(a.normal, b.normal), phi + 2 * theta, 1e-9);
    EXPECT_LT((a.center - first.center).norm(), 1e-12);
    EXPECT_LT((b.center - second.center).norm(), 1e-12);
    EXPECT_NEAR(a.radius, first.radius, 1e-12);  // rigid
  }
  EXPECT_GT(looked_at, 100);
}

TEST(PerturbByRotation, LowersTheNumberOfPairsAndKeepsASolidWithinTheGuard) {
  for (const TriangleMesh& mesh :
       {shapes::Sphere(1.0, 3), shapes::Cylinder(1.0, 3.0, 64), shapes::Box({1, 2, 3})}) {
    for (const double beta : {0.075, 0.3}) {
      RotationOptions options;
      options.beta = beta;
      options.iterations_per_face = 10;
      const PerturbResult result = Rotated(mesh, options);
      EXPECT_EQ(result.failure, "");
      EXPECT_LE(result.mesh.faces.size(), 350u);
      EXPECT_GT(result.moved, 0);
      EXPECT_LE(CompareNormals(result.start, result.mesh).largest, 60.0);
      EXPECT_EQ(WhyNotSolid(Inspect(result.mesh)), "");
    }
  }
}

TEST(PerturbByRotation, UncheckedItIsTheLiteralAlgorithmAndMayBreakTheMesh) {
  PerturbOptions common;
  common.unchecked = true;
  RotationOptions options;
  options.beta = 0.3;
  options.iterations_per_face = 10;
  const PerturbResult result = Rotated(shapes::Cylinder(1.0, 3.0, 64), options, common);
  EXPECT_TRUE(result.failure.starts_with("after: ")) << result.failure;
  EXPECT_EQ(result.refused[static_cast<std::size_t>(MoveVerdict::kIntersects)], 0);
}

TEST(PerturbByRotation, TurnsNothingOnceAllPairsAreAsFarApartAsTheCone) {
  // The sides of a wedge of 2 x 8 degrees: phi = 16 degrees, antipodal for psi > 8 degrees.
  const double t = std::tan(8 * kDegree);
  const TriangleMesh wedge{
      {{0, -1, 0}, {0, 1, 0}, {1, -1, t}, {1, 1, t}, {1, -1, -t}, {1, 1, -t}},
      {{0, 3, 1}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}}};
  ASSERT_EQ(WhyNotSolid(Inspect(wedge)), "");
  PerturbOptions common;
  common.cone = 10.0;
  common.max_width = 0.5;  // not the two ends, which are parallel
  const PerturbResult result = Rotated(wedge, {}, common);
  EXPECT_EQ(result.moved, 0);
  EXPECT_GT(result.no_gain, 0);
}

TEST(PerturbByRotation, IsTheSameForTheSameStream) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.4, 24, 12);
  EXPECT_EQ(Rotated(mesh, {}).mesh.vertices, Rotated(mesh, {}).mesh.vertices);
  EXPECT_NE(Rotated(mesh, {}).mesh.vertices, Rotated(mesh, {}, {}, 2).mesh.vertices);
  RotationOptions none;
  none.iterations_per_face = 0.0;
  const PerturbResult decimated = Rotated(mesh, none);
  EXPECT_EQ(decimated.mesh.vertices, decimated.start.vertices);
  EXPECT_EQ(decimated.failure, "");
}

TEST(Decimate, KeepsTheSolidItsVolumeAndItsTopology) {
  for (const TriangleMesh& mesh : {shapes::Sphere(1.0, 4), shapes::Torus(1.0, 0.4, 64, 32)}) {
    const DecimateResult result = Decimate(mesh, 350);
    EXPECT_EQ(result.failure, "");
    EXPECT_LT(result.mesh.faces.size(), 350u);
    EXPECT_GE(result.mesh.faces.size(), 346u);
    EXPECT_NEAR(Volume(result.mesh), Volume(mesh), 0.005 * Volume(mesh));
    EXPECT_EQ(Inspect(result.mesh).genus, Inspect(mesh).genus);
  }
  const TriangleMesh small = shapes::Cube();
  EXPECT_EQ(Decimate(small, 350).mesh.vertices, small.vertices);
  EXPECT_EQ(Decimate(small, 12).mesh.faces, small.faces);
}

}  // namespace
}  // namespace antigrasp
