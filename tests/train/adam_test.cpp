#include "antigrasp/train/adam.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <stdexcept>

namespace antigrasp {
namespace {

torch::Tensor Zeros(std::int64_t n) { return torch::zeros({n}, torch::kDouble); }

TEST(Adam, FirstStepMovesEveryParameterByTheRateAgainstItsGradient) {
  // Both corrected moments are those of the gradient itself: rate g / sqrt(g^2), whatever the
  // betas.
  for (const auto& [beta1, beta2] : {std::pair{0.0, 0.9}, {0.5, 0.999}, {0.9, 0.25}}) {
    const torch::Tensor a = torch::tensor({1.0, 2.0}, torch::kDouble), b = Zeros(3);
    Adam adam({a, b}, beta1, beta2);
    adam.Step({torch::tensor({3.0, -0.02}, torch::kDouble),
               torch::tensor({-40.0, 0.0, 5.0}, torch::kDouble)},
              0.25);
    EXPECT_TRUE(torch::allclose(a, torch::tensor({0.75, 2.25}, torch::kDouble), 0, 1e-6)) << a;
    EXPECT_TRUE(torch::allclose(b, torch::tensor({0.25, 0.0, -0.25}, torch::kDouble), 0, 1e-6))
        << b;
  }
}

// Longer than what goes to a thread at a time, and not in the order of its gradient.
TEST(Adam, LongParametersMoveAsElementsDo) {
  for (const bool turned : {false, true}) {
    const torch::Tensor g = torch::linspace(-3, 2, 70000).view({70, 1000});
    const torch::Tensor gradient = turned ? g.t().contiguous().t() : g;
    const torch::Tensor x = torch::zeros({70, 1000}), first = torch::zeros({1}),
                        last = first.clone();
    Adam whole({x}, 0.5, 0.75), ends({first, last}, 0.5, 0.75);
    for (int step = 0; step < 2; ++step) {
      whole.Step({gradient}, 0.5);
      ends.Step({g[0].slice(0, 0, 1), g[69].slice(0, 999)}, 0.5);
    }
    EXPECT_FLOAT_EQ(x[0][0].item<float>(), first.item<float>());
    EXPECT_FLOAT_EQ(x[69][999].item<float>(), last.item<float>());
    EXPECT_EQ(torch::count_nonzero(x).item<std::int64_t>(), 70000);
  }
}

TEST(Adam, SecondStepIsThatOfTheTwoMeans) {
  const torch::Tensor x = Zeros(1);
  Adam adam({x}, 0.5, 0.75);
  adam.Step({torch::ones({1}, torch::kDouble)}, 0.5);
  // m = 0.5 1, v = 0.25 1.
  EXPECT_DOUBLE_EQ(adam.first_moments()[0].item<double>(), 0.5);
  EXPECT_DOUBLE_EQ(adam.second_moments()[0].item<double>(), 0.25);
  const double before = x.item<double>();
  adam.Step({torch::full({1}, 3.0, torch::kDouble)}, 0.5);
  // m = 0.25 + 0.5 3 = 1.75, v = 0.1875 + 0.25 9 = 2.4375; corrected by 1 - 0.25 and 1 - 0.5625.
  EXPECT_DOUBLE_EQ(adam.first_moments()[0].item<double>(), 1.75);
  EXPECT_DOUBLE_EQ(adam.second_moments()[0].item<double>(), 2.4375);
  EXPECT_NEAR(before - x.item<double>(), 0.5 * (1.75 / 0.75) / std::sqrt(2.4375 / 0.4375), 1e-7);
  EXPECT_EQ(adam.steps().item<std::int64_t>(), 2);
}

TEST(Adam, EpsilonStandsBesideTheRootOfTheSecondMoment) {
  // g = 1e-8 = epsilon: rate 1e-8 / (1e-8 + 1e-8).
  const torch::Tensor x = Zeros(1);
  Adam adam({x}, 0.5, 0.75);
  adam.Step({torch::full({1}, 1e-8, torch::kDouble)}, 0.25);
  EXPECT_NEAR(x.item<double>(), -0.125, 1e-12);
}

TEST(Adam, RestartMakesTheNextStepTheFirst) {
  const torch::Tensor x = Zeros(1);
  Adam adam({x}, 0.5, 0.75);
  adam.Step({torch::full({1}, 7.0, torch::kDouble)}, 0.25);
  adam.Restart();
  EXPECT_EQ(adam.steps().item<std::int64_t>(), 0);
  EXPECT_EQ(adam.first_moments()[0].item<double>(), 0.0);
  EXPECT_EQ(adam.second_moments()[0].item<double>(), 0.0);
  adam.Step({torch::full({1}, -1.0, torch::kDouble)}, 0.5);
  EXPECT_NEAR(x.item<double>(), -0.25 + 0.5, 1e-7);
  EXPECT_THROW(adam.Step({}, 0.5), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
