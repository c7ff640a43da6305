#include "antigrasp/train/symmetries.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <map>
#include <set>

namespace antigrasp {
namespace {

// One grid that no symmetry of the cube maps to itself: value x + 10 y + 100 z.
torch::Tensor Numbered(std::int64_t count) {
  const torch::Tensor axis = torch::arange(4, torch::kFloat);
  const torch::Tensor grid = axis + 10 * axis.view({4, 1}) + 100 * axis.view({4, 1, 1});
  return grid.view({1, 1, 4, 4, 4}).expand({count, 1, 4, 4, 4}).clone();
}

// The corner values identify the symmetry.
std::set<std::vector<float>> Shown(Symmetries symmetries) {
  RngStream rng(1, "symmetries");
  const torch::Tensor shown = RandomSymmetries(Numbered(400), symmetries, &rng);
  std::set<std::vector<float>> found;
  for (std::int64_t i = 0; i < shown.size(0); ++i) {
    std::vector<float> corners;
    for (const std::int64_t z : {0, 3}) {
      for (const std::int64_t y : {0, 3}) {
        for (const std::int64_t x : {0, 3}) corners.push_back(shown[i][0][z][y][x].item<float>());
      }
    }
    found.insert(corners);
  }
  return found;
}

TEST(Symmetries, NoneChangesNothingAndDrawsNothing) {
  RngStream rng(1, "symmetries"), untouched(1, "symmetries");
  EXPECT_TRUE(torch::equal(RandomSymmetries(Numbered(3), Symmetries::kNone, &rng), Numbered(3)));
  EXPECT_EQ(rng.NextU64(), untouched.NextU64());
}

TEST(Symmetries, AroundZShowsAllEightAndNeverTurnsUpsideDown) {
  const auto found = Shown(Symmetries::kAroundZ);
  EXPECT_EQ(found.size(), 8u);
  for (const auto& corners : found) EXPECT_LT(corners[0], corners[4]);  // z still grows upwards
}

TEST(Symmetries, AroundZAndUpShowsAllSixteen) {
  EXPECT_EQ(Shown(Symmetries::kAroundZAndUp).size(), 16u);
}

TEST(Symmetries, EveryViewHoldsTheSameValues) {
  RngStream rng(2, "symmetries");
  const torch::Tensor shown = RandomSymmetries(Numbered(20), Symmetries::kAroundZAndUp, &rng);
  const auto sorted = std::get<0>(Numbered(1).flatten().sort());
  for (std::int64_t i = 0; i < 20; ++i) {
    EXPECT_TRUE(torch::equal(std::get<0>(shown[i].flatten().sort()), sorted));
  }
}

// Numbered(1) with x and y exchanged or not, then mirrored along the axes named: what may be shown.
std::vector<torch::Tensor> AllSymmetries(bool upside_down) {
  std::vector<torch::Tensor> all;
  const torch::Tensor axis = torch::arange(4, torch::kFloat);
  for (int i = 0; i < (upside_down ? 16 : 8); ++i) {
    const torch::Tensor x = (i & 1) != 0 ? 3 - axis : axis, y = (i & 2) != 0 ? 3 - axis : axis;
    const torch::Tensor z = (i & 8) != 0 ? 3 - axis : axis;
    const double along_x = (i & 4) != 0 ? 10.0 : 1.0;
    all.push_back((along_x * x + (10.0 / along_x) * y.view({4, 1}) + 100 * z.view({4, 1, 1}))
                      .view({1, 4, 4, 4}));
  }
  return all;
}

TEST(Symmetries, AreThoseThatKeepTheZAxisEachAsOften) {
  for (const bool upside_down : {false, true}) {
    RngStream rng(4, "symmetries");
    const std::vector<torch::Tensor> all = AllSymmetries(upside_down);
    const torch::Tensor shown = RandomSymmetries(
        Numbered(800), upside_down ? Symmetries::kAroundZAndUp : Symmetries::kAroundZ, &rng);
    std::map<std::size_t, double> times;
    for (std::int64_t i = 0; i < shown.size(0); ++i) {
      std::size_t k = 0;
      while (k < all.size() && !torch::equal(shown[i], all[k])) ++k;
      ASSERT_LT(k, all.size()) << "not one of them";
      ++times[k];
    }
    const double share = 800.0 / static_cast<double>(all.size());
    EXPECT_EQ(times.size(), all.size());
    for (const auto& [k, count] : times) EXPECT_NEAR(count, share, 0.5 * share) << k;
  }
}

}  // namespace
}  // namespace antigrasp
