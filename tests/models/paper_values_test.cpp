// Numbers of the networks' parts that are known on paper.
#include <gtest/gtest.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/model_options.h"
#include "antigrasp/models/norm_relu.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/models/spectral_norm.h"

namespace antigrasp {
namespace {

SpectralWeight WeightOf(const torch::Tensor& values, const torch::Tensor& u) {
  SpectralWeight weight(values.sizes(), true);
  torch::NoGradGuard no_grad;
  weight->parameters()[0].copy_(values);
  weight->buffers()[0].copy_(u);
  return weight;
}

TEST(SpectralNorm, SigmaOfARankOneWeightIsTheProductOfItsLengths) {
  // (1, 2, 2) (2, 3, 6)^T: 3 * 7. Rows are outputs; a kernel's taps are columns.
  const torch::Tensor column = torch::tensor({1.0F, 2.0F, 2.0F}).view({3, 1, 1, 1, 1});
  const torch::Tensor values = column * torch::tensor({2.0F, 3.0F, 6.0F}).view({1, 1, 1, 1, 3});
  SpectralWeight weight = WeightOf(values, torch::tensor({0.0F, 1.0F, 0.0F}));
  EXPECT_TRUE(torch::allclose(weight(), values / 21.0, 1e-6, 0));
  EXPECT_NEAR(weight->Sigma().item<double>(), 21.0, 1e-5);
  EXPECT_TRUE(torch::allclose(weight->buffers()[0], torch::tensor({1.0F, 2.0F, 2.0F}) / 3));
}

TEST(SpectralNorm, AForwardInTrainingMakesOneStepAndInEvaluationNone) {
  // W = diag(3, 4), u = (0.6, 0.8): W^T u = (1.8, 3.2), W W^T u = (5.4, 12.8).
  const torch::Tensor values = torch::diag(torch::tensor({3.0F, 4.0F}));
  const torch::Tensor u = torch::tensor({0.6F, 0.8F});
  SpectralWeight weight = WeightOf(values, u);
  weight->eval();
  // u^T W v with v = (1.8, 3.2) / |.|, which is |W^T u|.
  EXPECT_TRUE(torch::allclose(weight(), values / std::hypot(1.8, 3.2), 1e-6, 0));
  EXPECT_TRUE(torch::equal(weight->buffers()[0], u));
  weight->train();
  const double x = 5.4 / std::hypot(5.4, 12.8), y = 12.8 / std::hypot(5.4, 12.8);
  EXPECT_TRUE(torch::allclose(weight(), values / std::hypot(3 * x, 4 * y), 1e-6, 0));
  EXPECT_NEAR(weight->buffers()[0][0].item<double>(), x, 1e-6);
  EXPECT_NEAR(weight->buffers()[0][1].item<double>(), y, 1e-6);
}

TEST(NormRelu, DividesByTheRootOfVarianceAndEpsilon) {
  // Values 0.002 and -0.002: variance 4e-6, epsilon 1e-5, so 0.002 / sqrt(1.4e-5) = 0.5345.
  torch::NoGradGuard no_grad;
  torch::nn::BatchNorm3d norm(8);
  const torch::Tensor sign = torch::arange(16).remainder(2).mul(-2).add(1).to(torch::kFloat);
  const torch::Tensor x = (0.002 * sign).view({1, 1, 1, 4, 4}).expand({1, 8, 1, 4, 4}).contiguous();
  const torch::Tensor y = NormRelu(norm, x);
  EXPECT_NEAR(y.max().item<double>(), 0.002 / std::sqrt(1.4e-5), 1e-5);
  EXPECT_EQ(y.min().item<double>(), 0.0);
  // Running statistics: a tenth of the batch's, the variance over n - 1 = 15.
  EXPECT_NEAR(norm->running_var[3].item<double>(), 0.9 + 0.1 * 4e-6 * 16 / 15, 1e-7);
  norm->eval();
  norm->running_mean.fill_(0.5);
  norm->running_var.fill_(3e-5);
  EXPECT_NEAR(NormRelu(norm, x + 0.5).max().item<double>(), 0.002 / std::sqrt(4e-5), 1e-5);
}

TEST(Folding, ChannelsOfACellAreItsNodesPhaseByPhase) {
  // Node (z, y, x) of channel c has the number 1 + c + 10 x + 100 y + 1000 z.
  const torch::Tensor axis = torch::arange(4, torch::kFloat);
  const torch::Tensor nodes = 1 + 10 * axis + 100 * axis.view({4, 1}) + 1000 * axis.view({4, 1, 1});
  const torch::Tensor grid = torch::stack({nodes, nodes + 1}).unsqueeze(0);
  const torch::Tensor folded = Fold(grid), general = Fold(grid.to(torch::kDouble));
  for (int i = 0; i < 16 * 27; ++i) {
    const int channel = i / 27, p = channel / 2, c = channel % 2;
    const int cz = i / 9 % 3, cy = i / 3 % 3, cx = i % 3;
    const int z = 2 * cz + (p >> 2) - 1, y = 2 * cy + (p >> 1 & 1) - 1, x = 2 * cx + (p & 1) - 1;
    const bool ring = std::min({z, y, x}) < 0 || std::max({z, y, x}) > 3;
    const float expected = ring ? 0.0F : static_cast<float>(1 + c + 10 * x + 100 * y + 1000 * z);
    ASSERT_EQ(folded[0][channel][cz][cy][cx].item<float>(), expected) << i;
    ASSERT_EQ(general[0][channel][cz][cy][cx].item<float>(), expected) << i;
  }
}

TEST(NormalTensor, HoldsTheStreamsNormalsInOrderTimesTheDeviation) {
  RngStream rng(3, "normals"), same(3, "normals");
  const torch::Tensor tensor = NormalTensor({2, 3}, 2.5, &rng);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(tensor[i / 3][i % 3].item<float>(), static_cast<float>(2.5 * same.Normal()));
  }
}

TEST(SdfValues, LargestDistanceIsThatOfTheLargestValue) {
  ModelOptions options;
  options.truncation = 0.25;
  EXPECT_DOUBLE_EQ(LargestDistance(options), 0.25);
  options.truncation = 0.0;
  options.raw_scale = 2.0;
  EXPECT_DOUBLE_EQ(LargestDistance(options), 0.5);
  options.squash = Squash::kTanh;
  EXPECT_NEAR(LargestDistance(options), 0.5 * std::atanh(0.9999), 1e-12);
  const torch::Tensor inside = torch::tensor({0.25F});  // positive stays positive
  EXPECT_NEAR(NetworkValues(inside, options).item<double>(), std::tanh(0.5), 1e-6);
  EXPECT_NEAR(Distances(torch::tensor({1.0F}), options).item<double>(), LargestDistance(options),
              1e-3);
}

TEST(ModelOptions, EachNameSetsItsOwnField) {
  ModelOptions options;
  OptionTable table;
  Bind(&table, &options);
  for (const char* setting :
       {"model.width=3", "model.latent=4", "model.resolution=32", "model.spectral_norm=false",
        "model.pack=5", "model.pack_at=\"features\"", "model.width_d=6",
        "model.block=\"residual_generator\"", "model.edge_gain=0.7", "model.squash=\"tanh\"",
        "model.truncation=0.8", "model.raw_scale=0.9", "model.precision=\"bfloat16\"",
        "model.kind=\"solids\"", "model.parts=7", "model.depth=0.03", "model.form=\"turned\""}) {
    table.ApplyOverride(setting);
  }
  EXPECT_EQ(options.width, 3);
  EXPECT_EQ(options.latent, 4);
  EXPECT_FALSE(options.spectral_norm);
  EXPECT_TRUE(options.batch_norm && options.output_blur);
  EXPECT_EQ(options.pack, 5);
  EXPECT_EQ(options.pack_at, PackAt::kFeatures);
  EXPECT_EQ(options.width_d, 6);
  EXPECT_EQ(options.block, Block::kResidualGenerator);
  EXPECT_EQ(options.edge_gain, 0.7);
  EXPECT_EQ(options.squash, Squash::kTanh);
  EXPECT_EQ(options.truncation, 0.8);
  EXPECT_EQ(options.raw_scale, 0.9);
  EXPECT_EQ(options.precision, Precision::kBfloat16);
  EXPECT_EQ(options.kind, ModelKind::kSolids);
  EXPECT_EQ(options.parts, 7);
  EXPECT_EQ(options.form, PartForm::kTurned);
  EXPECT_EQ(options.depth, 0.03);
  table.ApplyOverride("model.batch_norm=false");
  EXPECT_TRUE(!options.batch_norm && options.output_blur);
  table.ApplyOverride("model.output_blur=false");
  EXPECT_FALSE(options.output_blur);
  EXPECT_EQ(table.options().size(), 19U);
}

}  // namespace
}  // namespace antigrasp
