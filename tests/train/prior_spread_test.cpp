#include "antigrasp/train/prior_spread.h"

#include <gtest/gtest.h>

#include <cmath>

namespace antigrasp {
namespace {

// Shapes of two values each.
torch::Tensor Shapes(const std::vector<float>& first) {
  torch::Tensor shapes = torch::zeros({static_cast<std::int64_t>(first.size()), 1, 1, 1, 2});
  for (std::size_t i = 0; i < first.size(); ++i) {
    shapes[static_cast<std::int64_t>(i)].view(-1)[0] = first[i];
  }
  return shapes;
}

// To their nearest other one: 1, 1, 2, 4.
TEST(PriorSpread, IsAPercentileOfTheDistancesToTheNearestOtherShape) {
  const torch::Tensor prior = Shapes({0.0F, 1.0F, 3.0F, 7.0F});
  EXPECT_NEAR(PriorSpread(prior, 100.0).limit(), 4.0, 1e-5);
  EXPECT_NEAR(PriorSpread(prior, 75.0).limit(), 2.0, 1e-5);
  EXPECT_NEAR(PriorSpread(prior, 50.0).limit(), 1.0, 1e-5);
  EXPECT_NEAR(PriorSpread(prior, 0.0).limit(), 1.0, 1e-5);
}

TEST(PriorSpread, MeasuresSamplesToTheNearestPriorShape) {
  const PriorSpread spread(Shapes({0.0F, 1.0F, 3.0F, 7.0F}), 95.0);
  torch::Tensor samples = Shapes({0.0F, 5.5F, 10.0F});
  samples[2].view(-1)[1] = 4.0F;  // the hypotenuse of 3 and 4
  const std::vector<double> nearest = spread.Nearest(samples);
  ASSERT_EQ(nearest.size(), 3U);
  EXPECT_NEAR(nearest[0], 0.0, 1e-3);
  EXPECT_NEAR(nearest[1], 1.5, 1e-5);
  EXPECT_NEAR(nearest[2], 5.0, 1e-5);
}

// More rows than are looked at together.
TEST(PriorSpread, OfManyShapesIsThatOfEachByItself) {
  std::vector<float> first;
  for (int i = 0; i < 600; ++i) first.push_back(0.5F * static_cast<float>(i));
  first.push_back(1000.0F);
  const torch::Tensor prior = Shapes(first).to(torch::kHalf);
  EXPECT_NEAR(PriorSpread(prior, 99.0).limit(), 0.5, 1e-2);
  EXPECT_NEAR(PriorSpread(prior, 100.0).limit(), 1000.0 - 299.5, 1.0);
}

}  // namespace
}  // namespace antigrasp
