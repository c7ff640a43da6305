#include "antigrasp/models/norm_relu.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>
#include <torch/utils.h>

#include "antigrasp/core/pieces.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/libtorch.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

torch::Tensor Normal(at::IntArrayRef shape, double sd, std::uint64_t stream) {
  RngStream rng(5, "norm_relu_test", stream);
  return NormalTensor(shape, sd, &rng);
}

// A normalisation with scales and shifts that mean something.
torch::nn::BatchNorm3d Norm(std::int64_t channels) {
  torch::nn::BatchNorm3d norm(channels);
  torch::NoGradGuard no_grad;
  norm->weight.copy_(1.0 + Normal({channels}, 0.3, 1));
  norm->bias.copy_(Normal({channels}, 0.5, 2));
  return norm;
}

void ExpectNear(const torch::Tensor& actual, const torch::Tensor& expected, const char* what) {
  EXPECT_LT((actual - expected).abs().max().item<double>(),
            1e-5 * expected.abs().max().item<double>())
      << what;
}

TEST(NormRelu, EqualsTheLayersItStandsForWithTheirGradientsAndStatistics) {
  for (const at::MemoryFormat format :
       {at::MemoryFormat::Contiguous, at::MemoryFormat::ChannelsLast3d}) {
    // Channels of every kind of block: 16, 8, and three by themselves.
    torch::nn::BatchNorm3d ours = Norm(27), plain = Norm(27);
    for (int step = 0; step < 3; ++step) {
      // Far from 0: the variance must not drown in the square of the mean.
      torch::Tensor x = (10.0 + Normal({5, 27, 8, 8, 7}, 1.0, 3 + step)).contiguous(format);
      torch::Tensor y = x.clone().requires_grad_();
      x.requires_grad_();
      const torch::Tensor actual = NormRelu(ours, x), expected = plain(y).relu();
      ExpectNear(actual, expected, "output");
      const torch::Tensor factor = Normal(x.sizes(), 1.0, 9);
      const auto a =
          torch::autograd::grad({(actual * factor).sum()}, {x, ours->weight, ours->bias});
      const auto b =
          torch::autograd::grad({(expected * factor).sum()}, {y, plain->weight, plain->bias});
      for (std::size_t i = 0; i < a.size(); ++i) ExpectNear(a[i], b[i], "gradient");
    }
    ExpectNear(ours->running_mean, plain->running_mean, "running mean");
    ExpectNear(ours->running_var, plain->running_var, "running variance");
    EXPECT_TRUE(torch::equal(ours->num_batches_tracked, plain->num_batches_tracked));
  }
}

TEST(NormRelu, EvaluatesWithStatisticsAveragedOverAllBatches) {
  torch::NoGradGuard no_grad;
  torch::nn::BatchNorm3d ours = Norm(16), plain = Norm(16);
  for (torch::nn::BatchNorm3d* norm : {&ours, &plain}) {
    (*norm)->options.momentum(kCumulativeMomentum);
    (*norm)->reset_running_stats();
  }
  for (int step = 0; step < 4; ++step) {
    const torch::Tensor x = 2.0 + Normal({3, 16, 2, 2, 2}, 0.5, step);
    NormRelu(ours, x);
    plain(x);
  }
  ours->eval();
  plain->eval();
  const torch::Tensor x = Normal({3, 16, 4, 4, 4}, 1.0, 9);
  ExpectNear(NormRelu(ours, x), plain(x).relu(), "output");
  torch::AutoGradMode gradients(true);
  torch::Tensor a = x.clone().requires_grad_(), b = x.clone().requires_grad_();
  NormRelu(ours, a).square().sum().backward();
  plain(b).relu().square().sum().backward();
  ExpectNear(a.grad(), b.grad(), "gradient");
}

TEST(NormRelu, GivesTheSameBitsWithAnyNumberOfThreads) {
  const int threads_before = PieceThreads();
  std::vector<torch::Tensor> first;
  for (const int threads : {1, 2, 3}) {
    SetPieceThreads(threads);
    torch::nn::BatchNorm3d norm = Norm(16);
    torch::Tensor x = Normal({7, 16, 8, 8, 8}, 1.0, 3).requires_grad_();
    const torch::Tensor y = NormRelu(norm, x);
    auto all = torch::autograd::grad({(y * y).sum()}, {x, norm->weight, norm->bias});
    all.push_back(y);
    if (first.empty()) first = all;
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(torch::equal(all[i], first[i])) << i;
  }
  SetPieceThreads(threads_before);
}

}  // namespace
}  // namespace antigrasp
