#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "antigrasp/sdf/marching_cubes.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/sdf/sdf_grid.h"
#include "tests/sdf/fields.h"
#include "tests/support/shapes.h"

// Where the nodes are, which number is whose, which side is positive: lopsided shapes away from
// the origin, and numbers instead of the formulas of the grid.
namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(SdfGrid, NodesAreTheMiddlesOfTheCellsOfTheUnitCube) {
  for (const SdfGrid& standard : {SdfGrid(), UnitCubeGrid()}) {
    EXPECT_EQ(standard.n, 32);
    EXPECT_EQ(standard.spacing, 0.03125);
    EXPECT_EQ(standard.Node(0, 0, 0), Vector3d(-0.484375, -0.484375, -0.484375));
    EXPECT_EQ(standard.Node(31, 31, 31), Vector3d(0.484375, 0.484375, 0.484375));
  }
  // The nodes of n = 4: -3/8, -1/8, 1/8, 3/8.
  const SdfGrid four = UnitCubeGrid(4);
  EXPECT_EQ(four.spacing, 0.25);
  EXPECT_EQ(four.Node(1, 2, 3), Vector3d(-0.125, 0.125, 0.375));
  EXPECT_EQ(four.values, std::vector<float>(64, 0.0F));
  EXPECT_EQ(UnitCubeGrid(1).Node(0, 0, 0), Vector3d::Zero());
  EXPECT_THROW(UnitCubeGrid(0), std::logic_error);
}

TEST(SdfGrid, XIsTheFastestIndexAndZTheSlowest) {
  const SdfGrid grid = UnitCubeGrid(4);
  EXPECT_EQ(grid.Index(1, 0, 0), 1u);
  EXPECT_EQ(grid.Index(0, 1, 0), 4u);
  EXPECT_EQ(grid.Index(0, 0, 1), 16u);
  EXPECT_EQ(grid.Index(1, 2, 3), 57u);
}

// A box of 1/4 x 1/2 x 3/4 around (1/8, 0, -1/8): x 0 to 1/4, y -1/4 to 1/4, z -1/2 to 1/4.
TEST(MeshToSdf, ALopsidedBoxIsPositiveInsideAtItsNodes) {
  const TriangleMesh box =
      Transformed(shapes::Box({0.25, 0.5, 0.75}), 1.0, Vector3d(0.125, 0.0, -0.125));
  SdfGrid grid = UnitCubeGrid(4);
  MeshToSdf(box, &grid);
  ASSERT_EQ(grid.values.size(), 64u);
  std::vector<int> inside;
  for (int i = 0; i < 64; ++i) {
    if (grid.values[i] > 0.0F) inside.push_back(i);
  }
  // x = 1/8: node 2; y = -+1/8: 1 and 2; z = -3/8, -1/8, 1/8: 0, 1 and 2.
  EXPECT_EQ(inside, (std::vector<int>{6, 10, 22, 26, 38, 42}));
  for (const int i : inside) EXPECT_EQ(grid.values[i], 0.125F);
  // Past the corners: (3/8, 3/8, 3/8) by 1/8 each, (-3/8, -3/8, 3/8) by 3/8, 1/8, 1/8.
  EXPECT_FLOAT_EQ(grid.values[63], static_cast<float>(-0.125 * std::sqrt(3.0)));
  EXPECT_FLOAT_EQ(grid.values[48], static_cast<float>(-0.125 * std::sqrt(11.0)));
  EXPECT_EQ(grid.values[5], -0.125F);  // (-1/8, -1/8, -3/8): 1/8 before the side x = 0
}

TEST(MeshToSdf, TheGridMayStandAnywhereWithAnySpacing) {
  SdfGrid grid;
  grid.n = 3;
  grid.spacing = 0.5;
  grid.origin = {1.0, -2.0, 3.0};
  // Node (1, 2, 0) is (1.5, -1, 3); a box of 0.2 x 0.4 x 0.6 around it, 0.1 from it at the nearest.
  MeshToSdf(Transformed(shapes::Box({0.2, 0.4, 0.6}), 1.0, Vector3d(1.5, -1.0, 3.0)), &grid);
  ASSERT_EQ(grid.values.size(), 27u);
  for (std::size_t i = 0; i < 27; ++i) EXPECT_EQ(grid.values[i] > 0.0F, i == 7) << i;
  EXPECT_FLOAT_EQ(grid.values[7], 0.1F);
  EXPECT_FLOAT_EQ(grid.values[6], -0.4F);   // half a unit along x, the side at 0.1
  EXPECT_FLOAT_EQ(grid.values[4], -0.3F);   // along y, at 0.2
  EXPECT_FLOAT_EQ(grid.values[16], -0.2F);  // along z, at 0.3
  EXPECT_FLOAT_EQ(grid.values[25], -0.7F);  // twice as far
}

// Rows are worked on in eights: lengths below, between and beyond.
TEST(MeshToSdf, RowsOfAnyLengthAreFilledToTheirEnd) {
  const Vector3d extents(0.3, 0.45, 0.6), center(0.15, -0.1, 0.05);
  for (const int n : {1, 3, 7, 8, 9, 11, 17}) {
    const SdfGrid exact =
        Sampled(n, [&](const Vector3d& p) { return BoxDistance(p - center, extents); });
    SdfGrid grid = UnitCubeGrid(n);
    MeshToSdf(Transformed(shapes::Box(extents), 1.0, center), &grid);
    for (std::size_t i = 0; i < exact.values.size(); ++i) {
      EXPECT_NEAR(grid.values[i], exact.values[i], 1e-7) << "n " << n << ", value " << i;
    }
  }
}

TEST(MeshDistance, IsTheLengthToTheNearestPointOnEitherSide) {
  const MeshDistance box(Transformed(shapes::Box({1, 2, 3}), 1.0, {10, 20, 30}));
  EXPECT_DOUBLE_EQ(box.Unsigned({10, 20, 30}), 0.5);
  EXPECT_DOUBLE_EQ(box.Unsigned({10.5, 20, 30}), 0.0);
  EXPECT_DOUBLE_EQ(box.Unsigned({10, 20, 33}), 1.5);
  EXPECT_DOUBLE_EQ(box.Unsigned({10.5 + 3, 21 + 4, 31}), 5.0);       // an edge
  EXPECT_DOUBLE_EQ(box.Unsigned({9.5 - 1, 19 - 2, 28.5 - 2}), 3.0);  // a corner
}

// One node inside, its six neighbours outside at other depths: 1 / (1 - outside) of the way, but no
// nearer to a node than the clamp.
TEST(MarchingCubes, CrossesWhereTheFieldBetweenTwoNodesIsZero) {
  SdfGrid grid;
  grid.n = 5;
  grid.spacing = 2.0;
  grid.origin = {100.0, 200.0, 300.0};
  grid.values.assign(125, -1.0F);
  const auto set = [&](int x, int y, int z, float value) {
    grid.values[25 * z + 5 * y + x] = value;
  };
  set(1, 2, 3, 1.0F);  // at (102, 204, 306)
  set(0, 2, 3, -1.0F);
  set(2, 2, 3, -3.0F);
  set(1, 1, 3, -9.0F);
  set(1, 3, 3, -0.25F);
  set(1, 2, 2, -0.0625F);  // 16/17, beyond the clamp
  set(1, 2, 4, -99.0F);    // 1/100, before it
  const auto crossings = [&](const TriangleMesh& mesh) {
    std::vector<double> steps;  // from the node: -x, +x, -y, +y, -z, +z
    const Vector3d node(102.0, 204.0, 306.0);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double side : {-1.0, 1.0}) {
        double furthest = 0.0;
        for (const Vector3d& v : mesh.vertices) {
          furthest = std::max(furthest, side * (v - node)[axis]);
        }
        steps.push_back(furthest / 2.0);
      }
    }
    return steps;
  };
  const auto expect = [&](const TriangleMesh& mesh, const std::vector<double>& expected) {
    EXPECT_EQ(mesh.vertices.size(), 6u);
    EXPECT_GT(Volume(mesh), 0.0);
    const std::vector<double> found = crossings(mesh);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
  };
  expect(MarchingCubes(grid), {0.5, 0.25, 0.1, 0.8, 16.0 / 17, 0.05});
  expect(MarchingCubes(grid, 0.05), {0.5, 0.25, 0.1, 0.8, 16.0 / 17, 0.05});
  expect(MarchingCubes(grid, 0.001), {0.5, 0.25, 0.1, 0.8, 16.0 / 17, 0.01});
  expect(MarchingCubes(grid, 0.2), {0.5, 0.25, 0.2, 0.8, 0.8, 0.2});
  set(1, 2, 2, -0.001F);
  expect(MarchingCubes(grid), {0.5, 0.25, 0.1, 0.8, 0.95, 0.05});
}

// The layer of outside around the grid is one spacing deep: 3/4 over 1/4 crosses at 3/4 of a step.
TEST(MarchingCubes, TheLayerAroundTheGridIsOneSpacingOutside) {
  SdfGrid grid = UnitCubeGrid(4);
  for (float& v : grid.values) v = 0.75F;
  const BoundingBox box = Bounds(MarchingCubes(grid));
  EXPECT_EQ(box.max, Vector3d::Constant(0.375 + 0.1875));
  EXPECT_EQ(box.min, Vector3d::Constant(-0.375 - 0.1875));
}

TEST(MarchingCubes, ALopsidedBoxComesBackWhereItWas) {
  const Vector3d extents(0.2, 0.4, 0.6), center(0.2, -0.15, 0.1);
  const TriangleMesh mesh = MarchingCubes(
      Sampled(32, [&](const Vector3d& p) { return BoxDistance(p - center, extents); }), 0.001);
  EXPECT_LT((Bounds(mesh).min - Vector3d(0.1, -0.35, -0.2)).norm(), 1e-6);
  EXPECT_LT((Bounds(mesh).max - Vector3d(0.3, 0.05, 0.4)).norm(), 1e-6);
}

}  // namespace
}  // namespace antigrasp
