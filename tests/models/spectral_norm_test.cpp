#include "antigrasp/models/spectral_norm.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/serialize.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <sstream>

#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

SpectralWeight MakeWeight(at::IntArrayRef shape, std::uint64_t stream) {
  SpectralWeight weight(shape, true);
  RngStream rng(11, "spectral_norm_test", stream);
  weight->Initialize(0.02, &rng);
  return weight;
}

double LargestSingularValue(const torch::Tensor& weight) {
  return torch::linalg_svdvals(weight.detach().flatten(1)).max().item<double>();
}

TEST(SpectralNorm, SigmaConvergesToTheLargestSingularValue) {
  for (const auto& shape : {std::vector<std::int64_t>{8, 4, 4, 4, 4}, {1, 64}, {16, 1, 4, 4, 4}}) {
    SpectralWeight weight = MakeWeight(shape, 1);
    const double expected = LargestSingularValue(weight->parameters()[0]);
    EXPECT_NEAR(weight->Sigma().item<double>(), expected, 0.05 * expected) << "after the warm-up";
    for (int i = 0; i < 300; ++i) {
      weight();
    }
    EXPECT_NEAR(weight->Sigma().item<double>(), expected, 1e-4 * expected);
    EXPECT_NEAR(LargestSingularValue(weight()), 1.0, 1e-4);
  }
}

TEST(SpectralNorm, TheNormalisedMapStretchesNoVector) {
  SpectralWeight weight = MakeWeight({6, 3, 4, 4, 4}, 2);
  for (int i = 0; i < 100; ++i) {
    weight();
  }
  const torch::Tensor matrix = weight().detach().flatten(1);
  RngStream rng(11, "vectors");
  const torch::Tensor x = NormalTensor({matrix.size(1), 200}, 1.0, &rng);
  const torch::Tensor ratio = matrix.matmul(x).norm(2, 0) / x.norm(2, 0);
  EXPECT_LE(ratio.max().item<double>(), 1.0 + 1e-4);
}

TEST(SpectralNorm, EvalModeIsFreeOfSideEffects) {
  SpectralWeight weight = MakeWeight({4, 2, 4, 4, 4}, 3);
  const torch::Tensor u = weight->buffers()[0].clone();
  weight->eval();
  EXPECT_TRUE(torch::equal(weight(), weight()));
  EXPECT_TRUE(torch::equal(weight->buffers()[0], u));
  weight->train();
  weight();
  EXPECT_FALSE(torch::equal(weight->buffers()[0], u));
}

TEST(SpectralNorm, VectorUIsSavedWithTheWeights) {
  SpectralWeight saved = MakeWeight({4, 2, 4, 4, 4}, 4), loaded = MakeWeight({4, 2, 4, 4, 4}, 5);
  std::stringstream file;
  torch::save(saved, file);
  torch::load(loaded, file);
  EXPECT_TRUE(torch::equal(loaded->buffers()[0], saved->buffers()[0]));
  EXPECT_TRUE(torch::equal(loaded(), saved()));
}

TEST(SpectralNorm, GradientMatchesFiniteDifferencesWithUAndVConstant) {
  SpectralWeight weight = MakeWeight({3, 2, 2}, 6);
  weight->to(torch::kDouble);
  for (int i = 0; i < 500; ++i) {  // at convergence du and dv change sigma only at second order
    weight();
  }
  weight->eval();
  RngStream rng(11, "coefficients");
  const torch::Tensor c = NormalTensor({3, 2, 2}, 1.0, &rng).to(torch::kDouble);
  const auto loss = [&] { return (weight() * c).sum(); };
  torch::Tensor parameter = weight->parameters()[0];
  const torch::Tensor gradient = torch::autograd::grad({loss()}, {parameter})[0].flatten();
  torch::NoGradGuard no_grad;
  torch::Tensor values = parameter.view({-1});
  constexpr double kStep = 1e-7;
  for (std::int64_t i = 0; i < values.numel(); ++i) {
    values[i] += kStep;
    const double up = loss().item<double>();
    values[i] -= 2 * kStep;
    const double down = loss().item<double>();
    values[i] += kStep;
    EXPECT_NEAR(gradient[i].item<double>(), (up - down) / (2 * kStep), 1e-4) << "entry " << i;
  }
}

TEST(SpectralNorm, TwoForwardsBeforeOneBackwardAreAllowed) {
  SpectralWeight weight = MakeWeight({4, 8}, 7);
  const torch::Tensor sum = weight().sum() + weight().sum();
  EXPECT_NO_THROW(sum.backward());
}

TEST(SpectralNorm, SwitchedOffItIsTheWeightItselfWithoutBuffers) {
  SpectralWeight weight(at::IntArrayRef{4, 8}, false);
  EXPECT_TRUE(torch::equal(weight(), weight->parameters()[0]));
  EXPECT_TRUE(weight->buffers().empty());
}

TEST(SpectralNorm, AZeroWeightStaysFinite) {
  SpectralWeight weight = MakeWeight({4, 8}, 8);
  torch::NoGradGuard no_grad;
  weight->parameters()[0].zero_();
  EXPECT_TRUE(torch::equal(weight(), torch::zeros({4, 8})));
}

}  // namespace
}  // namespace antigrasp
