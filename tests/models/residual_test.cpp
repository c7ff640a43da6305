// Both networks against the library's own layers where other tests leave something out: residual
// blocks, what fresh weights are, statistics near zero.
#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/generator.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

ModelOptions Residual() {
  ModelOptions options;
  options.width = 2;
  options.latent = 5;
  options.block = Block::kResidual;
  options.output_blur = options.spectral_norm = false;
  return options;
}

torch::Tensor Noise(at::IntArrayRef shape, std::uint64_t stream) {
  RngStream rng(9, "residual_test", stream);
  return NormalTensor(shape, 1.0, &rng);
}

// Weights that let every branch be seen.
void Scatter(torch::nn::Module* module, double sd) {
  torch::NoGradGuard no_grad;
  std::uint64_t stream = 100;
  for (auto& item : module->named_parameters()) {
    item.value().add_(sd * Noise(item.value().sizes(), stream++));
  }
}

double LargestDifference(const torch::Tensor& a, const torch::Tensor& b) {
  return (a - b).abs().max().item<double>();
}

TEST(ResidualBlocks, OfTheDiscriminatorAddAConvolutionOfTheCutValuesBeforeTheCut) {
  Discriminator discriminator(Residual());
  Scatter(discriminator.get(), 0.1);
  const auto parameters = discriminator->named_parameters();
  const torch::Tensor grid = Noise({3, 1, 32, 32, 32}, 1);
  torch::Tensor x = grid;
  for (int i = 1; i <= 4; ++i) {
    const std::string name = std::to_string(i);
    x = torch::conv3d(x, parameters["layer" + name + ".weight"], parameters["bias" + name], 2, 1);
    if (i < 4) {
      x = x + torch::conv3d(torch::leaky_relu(x, 0.2), parameters["refine" + name + ".weight"], {},
                            1, 1);
    }
    x = torch::leaky_relu(x, 0.2);
  }
  x = torch::linear(x.flatten(1), parameters["layer5.weight"], parameters["bias5"]).squeeze(1);
  EXPECT_GT(x.std().item<double>(), 0.1);
  EXPECT_LT(LargestDifference(discriminator(grid), x), 1e-4 * (1 + x.abs().max().item<double>()));
}

TEST(ResidualBlocks, OfTheGeneratorAddANormalisedConvolutionBeforeTheCut) {
  Generator generator(Residual());
  Scatter(generator.get(), 0.1);
  const auto parameters = generator->named_parameters();
  const auto norm = [&](const torch::Tensor& x, const std::string& name) {
    return torch::batch_norm(x, parameters[name + ".weight"], parameters[name + ".bias"], {}, {},
                             true, 0.1, 1e-5, false);
  };
  const torch::Tensor z = Noise({4, 5}, 2);
  torch::Tensor x = torch::linear(z, parameters["project.weight"]).view({4, -1, 2, 2, 2});
  x = torch::relu(norm(x, "norm0"));
  for (int i = 1; i <= 3; ++i) {
    const std::string name = std::to_string(i);
    x = torch::conv_transpose3d(x, parameters["up" + name + "_weight"], {}, 2, 1);
    x = torch::relu(norm(x, "norm" + name));
    const torch::Tensor y = torch::conv3d(x, parameters["refine" + name + "_weight"], {}, 1, 1);
    x = torch::relu(x + norm(y, "refine" + name + "_norm"));
  }
  x = torch::conv_transpose3d(x, parameters["last_weight"], parameters["last_bias"], 2, 1).tanh();
  EXPECT_GT(x.std().item<double>(), 0.1);
  EXPECT_LT(LargestDifference(generator(z), x), 2e-5);
}

TEST(ResidualBlocks, MayBeTheGeneratorsAlone) {
  ModelOptions options = Residual();
  options.block = Block::kResidualGenerator;
  EXPECT_EQ(Discriminator(options)->parameters().size(), 10U);
  EXPECT_EQ(Generator(options)->parameters().size(), 1U + 3 + 2 + 8 + 3 * 3);
}

TEST(Discriminator, LargestSigmaIsThatOfTheLargestWeightResidualOnesIncluded) {
  ModelOptions options = Residual();
  options.spectral_norm = true;
  Discriminator discriminator(options);
  for (const std::string name : {"layer1", "layer5", "refine2"}) {
    const double before = discriminator->LargestSigma();
    torch::NoGradGuard no_grad;
    torch::Tensor weight = discriminator->named_parameters()[name + ".weight"];
    torch::Tensor u = discriminator->named_buffers()[name + ".u"];
    // One entry, twice as large as what was the largest.
    weight.zero_();
    weight.view({weight.size(0), -1})[0][1] = 2.0 * before;
    u.zero_();
    u[0] = 1.0;
    EXPECT_NEAR(discriminator->LargestSigma(), 2.0 * before, 1e-5) << name;
  }
}

TEST(Generator, FoldingKeepsTheEpsilonOfSmallVariances) {
  ModelOptions options = Residual();
  options.block = Block::kPlain;
  Generator with(options);
  {
    torch::NoGradGuard no_grad;
    for (auto& item : with->named_buffers()) {
      if (item.key().ends_with("running_var")) item.value().fill_(2e-5);
      if (item.key().ends_with("running_mean")) item.value().fill_(1e-3);
    }
    for (auto& item : with->named_parameters()) {
      if (item.key().starts_with("norm")) item.value().mul_(0.01);  // far from saturation
    }
  }
  with->eval();
  options.batch_norm = false;
  Generator without(options);
  without->TakeFolded(*with);
  const torch::Tensor z = Noise({4, 5}, 3), expected = with(z);
  EXPECT_LT(LargestDifference(without(z), expected), 1e-5);
  EXPECT_GT((expected - std::tanh(-0.5)).abs().max().item<double>(), 1e-3);
  // 1 / sqrt(2e-5 + 1e-5) and -1e-3 times that, both times 0.01.
  const auto parameters = without->named_parameters();
  EXPECT_NEAR(parameters["bias2"].flatten()[0].item<double>(), -1e-5 / std::sqrt(3e-5), 1e-7);
  const torch::Tensor rows = with->named_parameters()["project.weight"];
  EXPECT_TRUE(torch::allclose(parameters["project.weight"], rows * (0.01 / std::sqrt(3e-5)), 1e-4));
}

TEST(Generator, FreshWeightsHaveTheirDeviations) {
  ModelOptions options;  // width 8, latent 200
  options.width = 4;
  const auto parameters = Generator(options)->named_parameters();
  EXPECT_NEAR(parameters["project.weight"].std().item<double>(), 1.0 / std::sqrt(200.0), 2e-3);
  EXPECT_EQ(parameters["last_bias"].item<float>(), -0.5F);
  EXPECT_TRUE(torch::equal(parameters["norm2.weight"], torch::ones({8})));
  // A kernel is a factor of deviation sqrt(2 / in) times the taps of linear interpolation.
  const torch::Tensor up = parameters["up1_weight"];  // [32, 16, 4, 4, 4]
  const torch::Tensor factors = up.select(4, 1).select(3, 1).select(2, 1) / (0.75 * 0.75 * 0.75);
  EXPECT_NEAR(factors.std().item<double>(), std::sqrt(2.0 / 32.0), 0.03);
  const torch::Tensor taps = torch::tensor({0.25F, 0.75F, 0.75F, 0.25F});
  const torch::Tensor linear = taps.view({4, 1, 1}) * taps.view({4, 1}) * taps;
  const torch::Tensor left = up - factors.view({32, 16, 1, 1, 1}) * linear;
  EXPECT_LT(left.std().item<double>(), 0.04 * std::sqrt(2.0 / 32.0));  // 2 % noise, here and there
  EXPECT_GT(left.std().item<double>(), 0.015 * std::sqrt(2.0 / 32.0));
}

TEST(Discriminator, FreshWeightsHaveTheDeviationOfDcganAndNoBias) {
  const auto parameters = Discriminator(ModelOptions())->named_parameters();
  for (const std::string name : {"2", "3", "4"}) {
    EXPECT_NEAR(parameters["layer" + name + ".weight"].std().item<double>(), 0.02, 1e-3) << name;
    EXPECT_EQ(parameters["bias" + name].abs().max().item<float>(), 0.0F);
  }
}

}  // namespace
}  // namespace antigrasp
