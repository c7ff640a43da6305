#include "antigrasp/mesh/weld.h"

#include <gtest/gtest.h>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

TEST(FirstEqual, FindsTheFirstOfEveryExactlyEqualPosition) {
  const std::vector<Eigen::Vector3d> positions{{1, 2, 3},       {0, 0, 0},         {1, 2, 3},
                                               {-0.0, 0, -0.0}, {1, 2, 3.0000001}, {1, 2, 3}};
  EXPECT_EQ(FirstEqual(positions), (std::vector<std::int32_t>{0, 1, 0, 1, 4, 0}));
  EXPECT_TRUE(FirstEqual({}).empty());
}

TEST(FirstNear, AgreesWithTheClustersOfAllPairs) {
  constexpr double kTolerance = 0.08;
  for (int trial = 0; trial < 20; ++trial) {
    RngStream rng(2, "near", trial);
    std::vector<Eigen::Vector3d> positions;
    for (int i = 0; i < 300; ++i) {
      positions.push_back({rng.Uniform(-1, 1), rng.Uniform(-0.5, 0.5), rng.Uniform(-0.3, 0.3)});
    }
    // Spread the smallest index over everything within reach until nothing changes.
    std::vector<std::int32_t> expected(positions.size());
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = static_cast<std::int32_t>(i);
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        for (std::size_t j = 0; j < positions.size(); ++j) {
          if ((positions[i] - positions[j]).norm() > kTolerance || expected[j] >= expected[i]) {
            continue;
          }
          expected[i] = expected[j];
          changed = true;
        }
      }
    }
    EXPECT_EQ(FirstNear(positions, kTolerance), expected);
  }
}

TEST(FirstNear, JoinsNothingAtZeroTolerance) {
  EXPECT_EQ(FirstNear({{0, 0, 0}, {0, 0, 1e-9}}, 0.0), (std::vector<std::int32_t>{0, 1}));
}

TEST(FirstNear, ATolerancesLengthIsStillNear) {
  const std::vector<Eigen::Vector3d> row{{0, 0, 0}, {0.75, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}};
  // Steps of exactly a quarter: one cluster, named by its first.
  EXPECT_EQ(FirstNear(row, 0.25), (std::vector<std::int32_t>{0, 0, 0, 0}));
  EXPECT_EQ(FirstNear(row, 0.2499), (std::vector<std::int32_t>{0, 1, 2, 3}));
  // 3-4-5: near in space, not near on each axis.
  EXPECT_EQ(FirstNear({{9, 9, 9}, {0, 3, 4}, {0, 0, 0}}, 5.0),
            (std::vector<std::int32_t>{0, 1, 1}));
  EXPECT_EQ(FirstNear({{9, 9, 9}, {0, 3, 4}, {0, 0, 0}}, 4.9),
            (std::vector<std::int32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace antigrasp
