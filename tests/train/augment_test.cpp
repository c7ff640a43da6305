#include "antigrasp/train/augment.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <array>
#include <map>
#include <set>

#include "antigrasp/models/folding.h"

namespace antigrasp {
namespace {

// Outside (-1) everywhere but for two shapes of one voxel each.
torch::Tensor TwoPoints() {
  torch::Tensor grid = torch::full({2, 1, 32, 32, 32}, -1.0);
  grid[0][0][10][12][14] = 1.0;
  grid[1][0][11][12][15] = 1.0;
  return grid;
}

std::vector<std::int64_t> PlaceOf(const torch::Tensor& grid) {
  const std::int64_t i = grid.flatten().argmax().item<std::int64_t>();
  return {i / 1024, i / 32 % 32, i % 32};
}

TEST(Augment, NoneReturnsTheBatchAndDrawsNothing) {
  RngStream rng(1, "augment"), untouched(1, "augment");
  const torch::Tensor folded = Fold(TwoPoints());
  EXPECT_TRUE(torch::equal(Augment(folded, Augmentation::kNone, &rng), folded));
  EXPECT_EQ(rng.NextU64(), untouched.NextU64());
}

TEST(Augment, MovesEveryShapeOfTheBatchAlikeAndNoFurtherThanTheLargestShift) {
  RngStream rng(1, "augment");
  std::set<std::vector<std::int64_t>> places;
  for (int draw = 0; draw < 50; ++draw) {
    const torch::Tensor moved = Unfold(Augment(Fold(TwoPoints()), Augmentation::kShifts, &rng));
    const std::vector<std::int64_t> a = PlaceOf(moved[0]), b = PlaceOf(moved[1]);
    EXPECT_EQ(moved.sum().item<float>(), TwoPoints().sum().item<float>());
    EXPECT_EQ(b, (std::vector<std::int64_t>{a[0] + 1, a[1], a[2] + 1}));
    EXPECT_LE(std::abs(a[0] - 10), kLargestShift);
    EXPECT_LE(std::abs(a[1] - 12), kLargestShift);
    EXPECT_LE(std::abs(a[2] - 14), kLargestShift);
    places.insert(a);
  }
  EXPECT_GT(places.size(), 30U);
}

TEST(Augment, MirrorsAboutTheMiddleOfTheGrid) {
  RngStream rng(1, "augment");
  std::set<std::vector<std::int64_t>> places;
  for (int draw = 0; draw < 100; ++draw) {
    places.insert(PlaceOf(Unfold(Augment(Fold(TwoPoints()), Augmentation::kFlips, &rng))[0]));
  }
  EXPECT_EQ(places.size(), 8U);
  EXPECT_TRUE(places.count({21, 19, 17}));
}

TEST(Augment, PassesTheGradientToWhereTheShapeCameFrom) {
  RngStream rng(3, "augment"), same(3, "augment");
  const torch::Tensor weights = torch::randn({2, 1, 32, 32, 32});
  const torch::Tensor grid = TwoPoints().requires_grad_();
  (Unfold(Augment(Fold(grid), Augmentation::kShiftsAndFlips, &rng)) * weights).sum().backward();
  // d/dgrid sum(w . shifted(grid)) at a node is the weight of the place it went to.
  const torch::Tensor moved =
      Unfold(Augment(Fold(TwoPoints()), Augmentation::kShiftsAndFlips, &same));
  const std::vector<std::int64_t> to = PlaceOf(moved[0]);
  EXPECT_EQ(grid.grad()[0][0][10][12][14].item<float>(),
            weights[0][0][to[0]][to[1]][to[2]].item<float>());
}

// Three grids, each node's own number along z, along y and along x.
torch::Tensor Rulers() {
  const torch::Tensor axis = torch::arange(32, torch::kFloat);
  return torch::stack({axis.view({32, 1, 1}).expand({32, 32, 32}),
                       axis.view({32, 1}).expand({32, 32, 32}), axis.expand({32, 32, 32})})
      .unsqueeze(1)
      .contiguous();
}

TEST(Augment, ShiftsEachAxisByItselfByUpToThreeAndRepeatsTheBorder) {
  RngStream rng(1, "augment");
  std::array<std::map<std::int64_t, int>, 3> shifts;
  std::set<std::vector<std::int64_t>> together;
  for (int draw = 0; draw < 140; ++draw) {
    const torch::Tensor moved = Unfold(Augment(Fold(Rulers()), Augmentation::kShifts, &rng));
    std::vector<std::int64_t> shift;
    for (std::int64_t axis = 0; axis < 3; ++axis) {
      shift.push_back(moved[axis][0][16][16][16].item<std::int64_t>() - 16);
      EXPECT_TRUE(torch::equal(moved[axis], (Rulers()[axis] + shift.back()).clamp(0, 31)));
      ++shifts[axis][shift.back()];
    }
    together.insert(shift);
  }
  for (const auto& times : shifts) {  // 20 of each expected
    ASSERT_EQ(times.size(), 7U);
    EXPECT_EQ(times.begin()->first, -3);
    EXPECT_EQ(times.rbegin()->first, 3);
    for (const auto& [shift, count] : times) EXPECT_NEAR(count, 20, 12) << shift;
  }
  EXPECT_GT(together.size(), 100U);  // of 343
}

TEST(Augment, MirrorsEachAxisHalfTheTime) {
  RngStream rng(1, "augment");
  std::map<std::vector<bool>, int> times;
  for (int draw = 0; draw < 160; ++draw) {
    const torch::Tensor moved = Unfold(Augment(Fold(Rulers()), Augmentation::kFlips, &rng));
    std::vector<bool> mirrored;
    for (std::int64_t axis = 0; axis < 3; ++axis) {
      mirrored.push_back(moved[axis][0][0][0][0].item<float>() == 31.0F);
      EXPECT_TRUE(
          torch::equal(moved[axis], mirrored.back() ? 31 - Rulers()[axis] : Rulers()[axis]));
    }
    ++times[mirrored];
  }
  EXPECT_EQ(times.size(), 8U);
  for (const auto& [mirrored, count] : times) EXPECT_NEAR(count, 20, 12);
}

}  // namespace
}  // namespace antigrasp
