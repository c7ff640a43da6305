#include "antigrasp/mesh/ray_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

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

// Whether a ray among near ones meets what it meets alone, to the last bit.
::testing::AssertionResult MeetsTheSame(const RayScene& scene, const Ray& ray,
                                        const std::optional<RayHit>& among) {
  const auto alone = scene.Closest(ray.origin, ray.direction, ray.length);
  if (alone.has_value() != among.has_value()) {
    return ::testing::AssertionFailure() << (alone ? "met alone" : "met among others");
  }
  if (!alone || (alone->face == among->face && alone->distance == among->distance &&
                 alone->point == among->point && alone->normal == among->normal &&
                 alone->front == among->front)) {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "face " << alone->face << " at " << alone->distance
                                       << ", not " << among->face << " at " << among->distance;
}

void ExpectTheSame(const RayScene& scene, const std::vector<Ray>& rays) {
  NearFaces near, line;
  scene.Near(rays, &near);
  std::vector<std::optional<RayHit>> hits(rays.size());
  scene.Closest(rays, near, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_TRUE(MeetsTheSame(scene, rays[i], hits[i])) << i;
    EXPECT_TRUE(MeetsTheSame(scene, rays[i], scene.Closest(rays[i], near))) << i << " one of them";
    scene.Near({&rays[i], 1}, &line);
    EXPECT_TRUE(MeetsTheSame(scene, rays[i], scene.Closest(rays[i], line))) << i << " by itself";
  }
}

// Rays beside each other, as a grasp's draws are: moved and turned a little.
std::vector<Ray> Beside(const Vector3d& origin, const Vector3d& direction, double spread,
                        double length, RngStream* rng) {
  std::vector<Ray> rays;
  for (int i = 0; i < 25; ++i) {
    rays.push_back(
        {origin + DrawPoint(spread, rng), (direction + DrawPoint(0.01, rng)).normalized(), length});
  }
  return rays;
}

TEST(NearRays, MeetWhatEachMeetsAlone) {
  const Vector3d far(30.0, -20.0, 5.0);
  const TriangleMesh torus = Transformed(shapes::Torus(0.02, 0.008, 60, 30), 1.0, far);
  const RayScene scene(torus);
  RngStream rng(1, "near rays");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) {
    const double length = i % 3 == 0 ? kInfinity : i % 3 == 1 ? 0.025 : 0.05;
    ExpectTheSame(scene,
                  Beside(far + DrawPoint(0.02, &rng), DrawDirection(&rng), 0.003, length, &rng));
  }
}

// Through corners and along edges several faces are met at one distance, and float arithmetic
// chooses.
TEST(NearRays, MeetTheSameFaceAtCornersAndEdges) {
  const TriangleMesh sphere = shapes::Sphere(0.03, 3);
  const RayScene scene(sphere);
  RngStream rng(2, "near rays");
  for (std::size_t i = 0; i < sphere.faces.size(); i += 7) {
    std::vector<Ray> rays;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto vertex = [&](std::size_t c) -> const Vector3d& {
        return sphere.vertices[static_cast<std::size_t>(sphere.faces[i][c % 3])];
      };
      const double share = rng.Uniform();
      for (const Vector3d& aim : {vertex(k), Vector3d(0.5 * (vertex(k) + vertex(k + 1))),
                                  Vector3d(vertex(k) + share * (vertex(k + 1) - vertex(k)))}) {
        for (const double off : {0.0, 1e-9, 1e-8}) {
          const Vector3d target = aim + DrawPoint(off, &rng);
          rays.push_back({1.7 * target, -target.normalized(), 0.05});
        }
      }
    }
    ExpectTheSame(scene, rays);
  }
}

TEST(NearRays, MeetTheSameFaceOfSheetsAndNeedlesAndAtTheirEnds) {
  TriangleMesh mesh = shapes::Box({0.03, 0.04, 0.05});
  for (const double gap : {0.0, 1e-10, 1e-8, 1e-6}) {  // sheets within another's rounding
    mesh = shapes::Joined(
        mesh, Transformed(shapes::Box({0.03 + gap, 0.02, 0.02}), 1.0, Vector3d(0.0, 0.005, 0.0)));
  }
  const auto first = static_cast<std::int32_t>(mesh.vertices.size());
  for (int i = 0; i < 40; ++i) {  // needles, some without area
    const double z = 0.001 * i - 0.02, wide = i % 4 == 0 ? 0.0 : std::pow(10.0, -3 - i % 9);
    mesh.vertices.insert(mesh.vertices.end(),
                         {{0.016, -0.02, z}, {0.017, 0.02, z}, {0.0165, 0.0, z + wide}});
    mesh.faces.push_back({first + 3 * i, first + 3 * i + 1, first + 3 * i + 2});
  }
  const RayScene scene(mesh);
  RngStream rng(3, "near rays");
  for (int i = 0; i < 400; ++i) {
    const Vector3d origin(0.04, 0.015 * rng.Uniform(-1.0, 1.0), 0.02 * rng.Uniform(-1.0, 1.0));
    // Behind, at and before the face at 0.015, by less than float knows and by more.
    const double end = 0.025 + std::array{0.0, 1e-10, -1e-9, 1e-8, -1e-6, 1e-3}[i % 6];
    std::vector<Ray> rays = Beside(origin, -Vector3d::UnitX(), 0.001, end, &rng);
    rays.push_back({origin, -Vector3d::UnitX(), end});
    rays.push_back({origin, Vector3d(-1.0, 1e-7, 0.0).normalized(), end});
    // Along a face, and from a face.
    rays.push_back({Vector3d(0.04, 0.02, origin.z()), -Vector3d::UnitX(), 0.05});
    rays.push_back({Vector3d(0.015, origin.y(), origin.z()), -Vector3d::UnitX(), 0.05});
    ExpectTheSame(scene, rays);
  }
}

// More rays than are cast together, beside more blocks than are listed together, and 80 faces on
// the way of each.
TEST(NearRays, MeetTheFirstOfManySheetsHoweverManyTheyAre) {
  TriangleMesh stack;
  for (int i = 0; i < 40; ++i) {
    stack = shapes::Joined(
        stack, Transformed(shapes::Box({1e-4, 0.02, 0.02}), 1.0, Vector3d(0.001 * i, 0.0, 0.0)));
  }
  const RayScene scene(stack);
  RngStream rng(4, "near rays");
  for (const double length : {0.0195, 0.0605, 1.0}) {  // into the stack, through it, beyond
    std::vector<Ray> rays;
    for (int i = 0; i < 4; ++i) {
      const auto some = Beside(Vector3d(-0.02, 0.0, 0.0), Vector3d::UnitX(), 0.009, length, &rng);
      rays.insert(rays.end(), some.begin(), some.end());
    }
    ExpectTheSame(scene, rays);
  }
}

// As of a plane mesh, where every cut has faces on both sides at one place.
TEST(NearRays, MeetTheFacesOfAFanThatLieAtOnePlace) {
  TriangleMesh fan;
  fan.vertices.push_back(Vector3d::Zero());
  constexpr int kCount = 97;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCount;
    fan.vertices.emplace_back(0.01 * std::cos(angle), 0.01 * std::sin(angle), 0.0);
    for (int copy = 0; copy < 3; ++copy) fan.faces.push_back({0, i + 1, (i + 1) % kCount + 1});
  }
  const RayScene scene(fan);
  RngStream rng(5, "near rays");
  for (int i = 0; i < 40; ++i) {
    ExpectTheSame(scene, Beside(Vector3d(0.0, 0.0, 0.02), -Vector3d::UnitZ(), 0.008, 0.05, &rng));
  }
}

TEST(NearRays, MeetNothingOfAMeshWithoutFaces) {
  const RayScene scene(TriangleMesh{});
  ExpectTheSame(scene, {{Vector3d::Zero(), Vector3d::UnitX(), 1.0}});
}

TEST(NearRays, MeetTheSameWhereFloatEnds) {
  for (const double scale : {1e-12, 1e-3, 1e12}) {
    const RayScene scene(Transformed(shapes::Cube(), scale, Vector3d::Zero()));
    ExpectTheSame(scene, {{Vector3d(-2.0, 0.1, 0.2) * scale, Vector3d::UnitX(), 10.0 * scale}});
  }
}

}  // namespace
}  // namespace antigrasp
