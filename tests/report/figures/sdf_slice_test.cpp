#include "antigrasp/report/figures/sdf_slice.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antigrasp {
namespace {

// f(p) at every node.
template <typename Field>
SdfGrid GridOf(int n, const Field& f) {
  SdfGrid grid = UnitCubeGrid(n);
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        grid.values[grid.Index(x, y, z)] = static_cast<float>(f(grid.Node(x, y, z)));
      }
    }
  }
  return grid;
}

TEST(SdfSlice, HasTheOtherTwoAxesInTheirOrderAndIsLinearBetweenLayers) {
  const SdfGrid grid =
      GridOf(8, [](const Eigen::Vector3d& p) { return p.x() + 10.0 * p.y() + 100.0 * p.z(); });
  const auto node = [&](int i) { return grid.Node(i, i, i).x(); };
  EXPECT_NEAR(MakeSlice(grid, 2, 0.1).At(3, 5), node(3) + 10.0 * node(5) + 10.0, 1e-4);
  EXPECT_NEAR(MakeSlice(grid, 1, 0.1).At(3, 5), node(3) + 1.0 + 100.0 * node(5), 1e-4);
  EXPECT_NEAR(MakeSlice(grid, 0, 0.1).At(3, 5), 0.1 + 10.0 * node(3) + 100.0 * node(5), 1e-4);
  EXPECT_NEAR(MakeSlice(grid, 2, -9.0).At(7, 0), node(7) + 10.0 * node(0) + 100.0 * node(0), 1e-4);
  EXPECT_NEAR(MakeSlice(grid, 2, 9.0).At(0, 0), 11.0 * node(0) + 100.0 * node(7), 1e-4);
}

TEST(SdfSlice, TheContourOfABallIsACircleThatCloses) {
  const SdfGrid grid = GridOf(32, [](const Eigen::Vector3d& p) { return 0.3 - p.norm(); });
  const auto contour = ZeroContour(MakeSlice(grid, 2, 0.0));
  double length = 0.0;
  for (const ContourPiece& piece : contour) {
    for (const auto& end : piece) {
      EXPECT_NEAR(std::hypot(end[0] - 15.5, end[1] - 15.5) / 32.0, 0.3, 1e-3);
    }
    length += std::hypot(piece[1][0] - piece[0][0], piece[1][1] - piece[0][1]) / 32.0;
  }
  EXPECT_NEAR(length, 2.0 * 3.14159265 * 0.3, 0.01);
}

TEST(SdfSlice, ASaddleIsCutOnceAcrossEachOfTwoCorners) {
  SdfSlice slice{2, {1.0f, -2.0f, -2.0f, 1.0f}};  // outside in the middle: two islands
  const auto pieces = ZeroContour(slice);
  ASSERT_EQ(pieces.size(), 2u);
  for (const ContourPiece& piece : pieces) {  // about (0, 0) or (1, 1)
    const double sum = piece[0][0] + piece[0][1] + piece[1][0] + piece[1][1];
    EXPECT_NEAR(std::abs(sum - 2.0), 4.0 / 3.0, 1e-6);
  }
  slice.values = {2.0f, -1.0f, -1.0f, 2.0f};  // inside in the middle: cut off the other corners
  for (const ContourPiece& piece : ZeroContour(slice)) {
    const double skew = piece[0][0] + piece[1][0] - piece[0][1] - piece[1][1];
    EXPECT_NEAR(std::abs(skew), 4.0 / 3.0, 1e-6);
  }
}

TEST(SdfSlice, NoContourWhereNothingChangesSignOrAValueIsNone) {
  EXPECT_TRUE(ZeroContour({2, {1.0f, 1.0f, 1.0f, 1.0f}}).empty());
  EXPECT_TRUE(ZeroContour({2, {1.0f, -1.0f, std::nanf(""), 1.0f}}).empty());
}

}  // namespace
}  // namespace antigrasp
