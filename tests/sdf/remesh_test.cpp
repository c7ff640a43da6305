#include "antigrasp/sdf/remesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "tests/sdf/fields.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

SdfGrid Ball(const Vector3d& center, double radius) {
  return Sampled(16, [=](const Vector3d& p) { return SphereDistance(p - center, radius); });
}

TEST(Remesh, BallIsOk) {
  const RemeshResult result = Remesh(Ball(Vector3d::Zero(), 0.3));
  EXPECT_EQ(result.status, RemeshStatus::kOk);
  EXPECT_TRUE(result.ok());
  EXPECT_TRUE(result.report.IsSolid());
  EXPECT_FALSE(result.mesh.faces.empty());
}

TEST(Remesh, NonFiniteGridIsReportedWithoutAMesh) {
  SdfGrid grid = Ball(Vector3d::Zero(), 0.3);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    grid.values[5] = bad;
    const RemeshResult result = Remesh(grid);
    EXPECT_EQ(result.status, RemeshStatus::kNonFinite);
    EXPECT_TRUE(result.mesh.faces.empty());
  }
}

TEST(Remesh, GridWithoutInsideIsEmpty) {
  const RemeshResult result = Remesh(UnitCubeGrid(8));  // zeros are outside
  EXPECT_EQ(result.status, RemeshStatus::kEmpty);
  EXPECT_FALSE(result.ok());
}

TEST(Remesh, BallThroughTheBorderTouchesTheBorder) {
  const SdfGrid grid = Ball(Vector3d(0.3, 0.0, 0.0), 0.3);
  const RemeshResult result = Remesh(grid);
  EXPECT_EQ(result.status, RemeshStatus::kTouchesBorder);
  EXPECT_TRUE(result.report.IsSolid());  // closed by the padding all the same
  EXPECT_EQ(Remesh(grid, {.check_self_intersection = true, .reject_border = false}).status,
            RemeshStatus::kOk);
}

TEST(Remesh, EveryFaceOfTheBorderCounts) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-0.3, 0.3}) {
      const Vector3d center = side * Vector3d::Unit(axis);
      EXPECT_EQ(Remesh(Ball(center, 0.25)).status, RemeshStatus::kTouchesBorder);
    }
  }
}

TEST(Remesh, TwoBallsAreDisjoint) {
  const auto two = Sampled(24, [](const Vector3d& p) {
    return std::max(SphereDistance(p - Vector3d(0.22, 0, 0), 0.15),
                    SphereDistance(p + Vector3d(0.22, 0, 0), 0.15));
  });
  const RemeshResult result = Remesh(two);
  EXPECT_EQ(result.status, RemeshStatus::kDisjoint);
  EXPECT_EQ(result.report.components, 2);
}

TEST(Remesh, AClosedVoidIsNoSecondPieceAndABallInItIs) {
  const auto shell = [](const Vector3d& p) {
    return std::min(SphereDistance(p, 0.4), -SphereDistance(p, 0.25));
  };
  const RemeshResult hollow = Remesh(Sampled(24, shell));
  EXPECT_EQ(hollow.status, RemeshStatus::kOk);
  EXPECT_TRUE(hollow.report.IsSolid());
  EXPECT_EQ(hollow.report.components, 2);
  EXPECT_EQ(hollow.report.voids, 1);
  const auto rattle =
      Sampled(24, [&](const Vector3d& p) { return std::max(shell(p), SphereDistance(p, 0.12)); });
  EXPECT_EQ(Remesh(rattle).status, RemeshStatus::kDisjoint);
  EXPECT_EQ(Remesh(rattle).report.voids, 1);
}

TEST(Remesh, EarlierTestsWin) {
  SdfGrid grid = WhiteNoise(8, 1);
  EXPECT_EQ(Remesh(grid).status, RemeshStatus::kTouchesBorder);  // and disjoint
  grid.values[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Remesh(grid).status, RemeshStatus::kNonFinite);
}

TEST(Remesh, EveryStatusHasItsNameAndNumber) {
  EXPECT_EQ(Name(RemeshStatus::kOk), "ok");
  EXPECT_EQ(Name(RemeshStatus::kNonFinite), "non_finite");
  EXPECT_EQ(Name(RemeshStatus::kEmpty), "empty");
  EXPECT_EQ(Name(RemeshStatus::kTouchesBorder), "touches_border");
  EXPECT_EQ(Name(RemeshStatus::kGaps), "gaps");
  EXPECT_EQ(Name(RemeshStatus::kNonManifold), "non_manifold");
  EXPECT_EQ(Name(RemeshStatus::kNonOrientable), "non_orientable");
  EXPECT_EQ(Name(RemeshStatus::kSelfIntersecting), "self_intersecting");
  EXPECT_EQ(Name(RemeshStatus::kDisjoint), "disjoint");
  // Tables have a column for each, in this order.
  EXPECT_EQ(static_cast<int>(RemeshStatus::kOk), 0);
  EXPECT_EQ(static_cast<int>(RemeshStatus::kTouchesBorder), 3);
  EXPECT_EQ(static_cast<int>(RemeshStatus::kDisjoint), kNumRemeshStatuses - 1);
  EXPECT_THROW(Name(static_cast<RemeshStatus>(kNumRemeshStatuses)), std::logic_error);
}

// A grid of outside with one node inside.
SdfGrid OneNode(int x, int y, int z) {
  SdfGrid grid = UnitCubeGrid(5);
  grid.values.assign(125, -1.0F);
  grid.values[25 * z + 5 * y + x] = 1.0F;
  return grid;
}

TEST(Remesh, TheBorderIsTheOutermostNodesAndNoMore) {
  const RemeshOptions quick{.check_self_intersection = false, .reject_border = true};
  for (int z = 0; z < 5; ++z) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) {
        const bool border = std::min({x, y, z}) == 0 || std::max({x, y, z}) == 4;
        EXPECT_EQ(Name(Remesh(OneNode(x, y, z), quick).status), border ? "touches_border" : "ok")
            << x << " " << y << " " << z;
      }
    }
  }
  // A node on the surface is outside.
  SdfGrid grid = OneNode(2, 2, 2);
  grid.values[0] = 0.0F;
  EXPECT_TRUE(Remesh(grid).ok());
}

TEST(Remesh, TheFirstReasonCounts) {
  // Two pieces, one of them at the border.
  SdfGrid grid = OneNode(2, 2, 2);
  grid.values[25 * 2 + 5 * 2] = 1.0F;
  EXPECT_EQ(Remesh(grid).status, RemeshStatus::kTouchesBorder);
  EXPECT_EQ(Remesh(grid).report.components, 2);
  EXPECT_FALSE(Remesh(grid).mesh.faces.empty());
  EXPECT_EQ(Remesh(grid, {.check_self_intersection = true, .reject_border = false}).status,
            RemeshStatus::kDisjoint);
  // A number that is none in a grid that is empty, or at its border.
  grid.values[7] = -std::numeric_limits<float>::infinity();
  EXPECT_EQ(Remesh(grid).status, RemeshStatus::kNonFinite);
  SdfGrid empty = UnitCubeGrid(5);
  empty.values[124] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Remesh(empty).status, RemeshStatus::kNonFinite);
  empty.values[124] = 0.0F;
  EXPECT_EQ(Remesh(empty).status, RemeshStatus::kEmpty);
  EXPECT_FALSE(Remesh(empty).report.closed);
  EXPECT_TRUE(Remesh(empty).mesh.vertices.empty());
  empty.values.pop_back();
  EXPECT_THROW(Remesh(empty), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
