#include "antigrasp/mesh/ray_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <optional>

#include "antigrasp/core/parallel.h"
#include "tests/support/random_draws.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Moeller and Trumbore over every face, in double.
std::optional<double> ClosestByAllFaces(const TriangleMesh& mesh, const Vector3d& origin,
                                        const Vector3d& direction) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& face : mesh.faces) {
    const Vector3d& a = mesh.vertices[static_cast<std::size_t>(face[0])];
    const Vector3d e1 = mesh.vertices[static_cast<std::size_t>(face[1])] - a;
    const Vector3d e2 = mesh.vertices[static_cast<std::size_t>(face[2])] - a;
    const Vector3d p = direction.cross(e2);
    const double det = e1.dot(p);
    if (det == 0.0) continue;
    const double u = (origin - a).dot(p) / det;
    const Vector3d q = (origin - a).cross(e1);
    const double v = direction.dot(q) / det;
    const double t = e2.dot(q) / det;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0) best = std::min(best, t);
  }
  if (best < std::numeric_limits<double>::infinity()) return best;
  return std::nullopt;
}

TEST(RayScene, CubeIsMetFromOutsideOnItsFrontFace) {
  const TriangleMesh cube = shapes::Cube();
  const RayScene scene(cube);
  const auto hit = scene.Closest(Vector3d(-2.0, 0.1, 0.2), Vector3d::UnitX(), 10.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->distance, 1.5);
  EXPECT_EQ(hit->point, Vector3d(-0.5, 0.1, 0.2));
  EXPECT_EQ(hit->normal, -Vector3d::UnitX());
  EXPECT_TRUE(hit->front);
  EXPECT_EQ(FaceCross(cube, hit->face).normalized(), -Vector3d::UnitX());
}

TEST(RayScene, CubeIsMetFromInsideOnABackFace) {
  const RayScene scene(shapes::Cube());
  const auto hit = scene.Closest(Vector3d(0.0, 0.1, 0.2), Vector3d::UnitX(), 10.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->distance, 0.5);
  EXPECT_EQ(hit->normal, Vector3d::UnitX());
  EXPECT_FALSE(hit->front);
}

TEST(RayScene, NothingIsMetBesideBehindOrBeyondTheReach) {
  const RayScene scene(shapes::Cube());
  EXPECT_FALSE(scene.Closest(Vector3d(-2.0, 0.7, 0.0), Vector3d::UnitX(), 10.0));
  EXPECT_FALSE(scene.Closest(Vector3d(2.0, 0.1, 0.0), Vector3d::UnitX(), 10.0));
  EXPECT_FALSE(scene.Closest(Vector3d(-2.0, 0.1, 0.0), Vector3d::UnitX(), 1.4));
  EXPECT_TRUE(scene.Closest(Vector3d(-2.0, 0.1, 0.0), Vector3d::UnitX(), 1.6));
}

TEST(RayScene, RandomRaysAgreeWithTryingEveryFace) {
  const TriangleMesh torus = shapes::Torus(2.0, 0.8, 40, 20);
  const RayScene scene(torus);
  RngStream rng(1, "rays");
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d origin = DrawPoint(2.0, &rng);
    const Vector3d direction = DrawDirection(&rng);
    const auto expected = ClosestByAllFaces(torus, origin, direction);
    const auto hit = scene.Closest(origin, direction, 100.0);
    ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
    if (!hit) continue;
    // On the silhouette float and double may pick neighbouring faces.
    EXPECT_NEAR(hit->distance, *expected, 1e-5) << i;
    ++hits;
  }
  EXPECT_GT(hits, 500);
}

TEST(RayScene, DistanceIsDoublePrecisionFarFromTheOrigin) {
  const Vector3d far(1000.0, -2000.0, 500.0);
  const RayScene scene(Transformed(shapes::Cube(), 0.04, far));
  const auto hit = scene.Closest(far + Vector3d(-0.05, 0.003, 0.001), Vector3d::UnitX(), 0.1);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance, 0.03, 1e-12);
}

TEST(RayScene, FacesWithoutAreaAreLeftOutAndFaceNumbersKept) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.faces = {{0, 1, 3}, {0, 0, 2}, {0, 1, 2}};
  const RayScene scene(mesh);
  const auto hit = scene.Closest(Vector3d(0.2, 0.2, 1.0), -Vector3d::UnitZ(), 2.0);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->face, 2u);
}

TEST(RayScene, AMeshWithoutFacesIsNeverMet) {
  EXPECT_FALSE(RayScene(TriangleMesh{}).Closest(Vector3d::Zero(), Vector3d::UnitX(), 1.0));
}

TEST(RayScene, ConcurrentQueriesGiveTheSameHits) {
  const RayScene scene(shapes::Sphere(1.0, 3));
  const auto distances = [&scene](int threads) {
    std::vector<double> result(4000);
    ParallelFor(4000, threads, [&](std::int64_t i) {
      RngStream rng(2, "rays", static_cast<std::uint64_t>(i));
      const auto hit = scene.Closest(DrawPoint(1.0, &rng), DrawDirection(&rng), 10.0);
      result[static_cast<std::size_t>(i)] = hit ? hit->distance : -1.0;
    });
    return result;
  };
  EXPECT_EQ(distances(1), distances(4));
}

}  // namespace
}  // namespace antigrasp
