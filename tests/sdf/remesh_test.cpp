#include "antigrasp/sdf/remesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

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

TEST(Remesh, CavityIsDisjoint) {
  const auto shell = Sampled(24, [](const Vector3d& p) {
    return std::min(SphereDistance(p, 0.4), -SphereDistance(p, 0.2));
  });
  EXPECT_EQ(Remesh(shell).status, RemeshStatus::kDisjoint);
}

TEST(Remesh, EarlierTestsWin) {
  SdfGrid grid = WhiteNoise(8, 1);
  EXPECT_EQ(Remesh(grid).status, RemeshStatus::kTouchesBorder);  // and disjoint
  grid.values[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Remesh(grid).status, RemeshStatus::kNonFinite);
}

TEST(Remesh, NamesAreDistinctLowerSnake) {
  std::set<std::string> names;
  for (int i = 0; i < kNumRemeshStatuses; ++i) {
    const std::string name(Name(static_cast<RemeshStatus>(i)));
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos);
    names.insert(name);
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kNumRemeshStatuses));
  EXPECT_EQ(Name(RemeshStatus::kNonFinite), "non_finite");
}

}  // namespace
}  // namespace antigrasp
