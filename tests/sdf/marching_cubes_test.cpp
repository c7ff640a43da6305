#include "antigrasp/sdf/marching_cubes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/inspect.h"
#include "tests/sdf/fields.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

// Closed, oriented outward in every piece, and not touching itself.
void ExpectEmbeddedManifold(const TriangleMesh& mesh, bool check_self_intersection = true) {
  const MeshReport report = Inspect(mesh, check_self_intersection);
  EXPECT_TRUE(report.finite);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.manifold);
  EXPECT_TRUE(report.oriented);
  EXPECT_FALSE(report.self_intersecting);
  EXPECT_EQ(report.degenerate_faces, 0);
}

SdfGrid OneCell(int corner_bits) {
  SdfGrid grid = UnitCubeGrid(2);
  for (std::size_t c = 0; c < 8; ++c) grid.values[c] = (corner_bits >> c & 1) != 0 ? 0.3F : -0.7F;
  return grid;
}

TEST(MarchingCubes, SphereVolumeConvergesToTheFormula) {
  const double expected = 4.0 / 3.0 * kPi * 0.4 * 0.4 * 0.4;
  double previous_error = 1.0;
  for (const int n : {16, 32, 64}) {
    const auto mesh =
        MarchingCubes(Sampled(n, [](const Vector3d& p) { return SphereDistance(p, 0.4); }));
    const double error = std::abs(Volume(mesh) - expected) / expected;
    EXPECT_LT(error, previous_error / 2.5) << n;
    previous_error = error;
  }
  EXPECT_LT(previous_error, 1e-3);
}

TEST(MarchingCubes, SphereIsOneComponentOfGenusZero) {
  const auto mesh =
      MarchingCubes(Sampled(32, [](const Vector3d& p) { return SphereDistance(p, 0.4); }));
  const MeshReport report = Inspect(mesh);
  EXPECT_TRUE(report.IsSolid());
  EXPECT_EQ(report.genus, 0);
  EXPECT_LT(report.center_of_mass.norm(), 1e-9);
}

TEST(MarchingCubes, TorusHasGenusOneAndItsVolume) {
  const auto mesh =
      MarchingCubes(Sampled(32, [](const Vector3d& p) { return TorusDistance(p, 0.28, 0.12); }));
  const MeshReport report = Inspect(mesh);
  EXPECT_TRUE(report.IsSolid());
  EXPECT_EQ(report.genus, 1);
  EXPECT_NEAR(report.volume, 2.0 * kPi * kPi * 0.28 * 0.12 * 0.12, 0.02 * report.volume);
}

TEST(MarchingCubes, BoxFacesLieExactlyInTheirPlanes) {
  const Vector3d extents(0.5, 0.35, 0.7);
  const auto mesh =
      MarchingCubes(Sampled(32, [&](const Vector3d& p) { return BoxDistance(p, extents); }), 0.001);
  EXPECT_TRUE(Inspect(mesh).IsSolid());
  const BoundingBox box = Bounds(mesh);
  EXPECT_LT((box.Extent() - extents).norm(), 1e-6);
  EXPECT_NEAR(Volume(mesh), extents.prod(), 0.015 * extents.prod());  // edges lose a bevel
}

TEST(MarchingCubes, EveryCornerCaseIsAClosedOrientedManifold) {
  for (int bits = 1; bits < 256; ++bits) {
    const TriangleMesh mesh = MarchingCubes(OneCell(bits));
    SCOPED_TRACE(bits);
    ExpectEmbeddedManifold(mesh);
    EXPECT_GT(Volume(mesh), 0.0);
  }
  EXPECT_TRUE(MarchingCubes(OneCell(0)).faces.empty());
}

TEST(MarchingCubes, WhiteNoiseGivesManifoldsWithoutSelfIntersection) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    ExpectEmbeddedManifold(MarchingCubes(WhiteNoise(10, seed), seed % 2 == 0 ? 0.05 : 0.001));
  }
  ExpectEmbeddedManifold(MarchingCubes(WhiteNoise(32, 7)), false);
}

// Equal sizes everywhere put crossings in highly symmetric places.
TEST(MarchingCubes, QuantisedNoiseGivesManifoldsWithoutSelfIntersection) {
  for (const float threshold : {0.2F, 0.6F}) {
    SdfGrid grid = WhiteNoise(10, 3);
    for (float& v : grid.values) v = v > threshold ? 1.0F : v < -threshold ? -1.0F : 0.0F;
    ExpectEmbeddedManifold(MarchingCubes(grid));
  }
}

TEST(MarchingCubes, GridFullyInsideGivesTheClosedBoxHalfACellBeyondTheNodes) {
  SdfGrid grid = UnitCubeGrid(4);
  for (float& v : grid.values) v = 0.25F;  // one spacing: crossings half way to the padding
  const TriangleMesh mesh = MarchingCubes(grid);
  const MeshReport report = Inspect(mesh);
  EXPECT_TRUE(report.IsSolid());
  EXPECT_EQ(report.genus, 0);
  EXPECT_LT((Bounds(mesh).Extent() - Vector3d::Ones()).norm(), 1e-12);
}

TEST(MarchingCubes, SingleInsideNodeIsAnOctahedron) {
  SdfGrid grid = UnitCubeGrid(5);
  for (float& v : grid.values) v = -1.0F;
  grid.values[grid.Index(2, 2, 2)] = 1.0F;
  const TriangleMesh mesh = MarchingCubes(grid);
  EXPECT_EQ(mesh.vertices.size(), 6U);
  EXPECT_EQ(mesh.faces.size(), 8U);
  const double half = 0.5 * grid.spacing;
  EXPECT_NEAR(Volume(mesh), 4.0 / 3.0 * half * half * half, 1e-15);
  EXPECT_TRUE(Inspect(mesh).IsSolid());
}

TEST(MarchingCubes, ExactZerosAreOutsideAndKeepTheSurfaceApart) {
  // A ball whose surface passes exactly through nodes, and a slab of nothing but zeros beside it.
  SdfGrid grid = UnitCubeGrid(9);
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 9; ++y) {
      for (int x = 0; x < 9; ++x) {
        const Vector3d p(x - 4, y - 4, z - 4);
        grid.values[grid.Index(x, y, z)] = static_cast<float>(std::max(9.0 - p.squaredNorm(), 0.0));
      }
    }
  }
  const TriangleMesh mesh = MarchingCubes(grid);
  EXPECT_TRUE(Inspect(mesh).IsSolid());
  for (float& v : grid.values) v = 0.0F;
  EXPECT_TRUE(MarchingCubes(grid).faces.empty());
}

TEST(MarchingCubes, DenormalAndHugeValuesGiveFiniteVertices) {
  SdfGrid grid = WhiteNoise(6, 11);
  RngStream rng(5, "exponents");
  for (float& v : grid.values) {
    const float size = rng.Below(2) == 0 ? std::numeric_limits<float>::denorm_min()
                                         : std::numeric_limits<float>::max();
    v = std::copysign(size, v);
  }
  ExpectEmbeddedManifold(MarchingCubes(grid));
}

TEST(MarchingCubes, NegatedFieldBoundsTheComplement) {
  SdfGrid grid = Sampled(16, [](const Vector3d& p) { return SphereDistance(p, 0.3); });
  const double ball = Volume(MarchingCubes(grid));
  for (float& v : grid.values) v = -v;
  const TriangleMesh shell = MarchingCubes(grid);
  EXPECT_GT(ball, 0.0);
  EXPECT_GT(Volume(shell), 0.5);
  EXPECT_EQ(Inspect(shell).components, 2);  // the box and the cavity
}

TEST(MarchingCubes, SameGridGivesTheSameMesh) {
  const SdfGrid grid = WhiteNoise(12, 1);
  const TriangleMesh a = MarchingCubes(grid), b = MarchingCubes(grid);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.faces, b.faces);
}

TEST(MarchingCubes, RefusesNonFiniteValuesAndWrongSizes) {
  SdfGrid grid = WhiteNoise(4, 1);
  grid.values[7] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(MarchingCubes(grid), std::logic_error);
  grid.values[7] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(MarchingCubes(grid), std::logic_error);
  grid.values.pop_back();
  EXPECT_THROW(MarchingCubes(grid), std::logic_error);
  EXPECT_THROW(MarchingCubes(WhiteNoise(4, 1), 0.0), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
