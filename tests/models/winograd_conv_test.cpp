#include "antigrasp/models/winograd_conv.h"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <array>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

torch::Tensor Normal(at::IntArrayRef shape, std::uint64_t stream) {
  RngStream rng(11, "winograd_conv_test", stream);
  return NormalTensor(shape, 1.0, &rng);
}

// Samples, channels and side of a grid, and what a layer of the discriminator makes of them.
struct Layer {
  std::int64_t count, in, side, out;
};

// The convolution, its transpose of what it gave, and the gradients of both for cells and weight.
std::vector<torch::Tensor> Results(const Layer& layer, at::ScalarType type) {
  const std::int64_t h = layer.side / 2 + 1;
  const torch::Tensor cells =
      Normal({layer.count, 8 * layer.in, h, h, h}, 1).to(type).requires_grad_();
  const torch::Tensor weight = Normal({layer.out, layer.in, 4, 4, 4}, 2).to(type).requires_grad_();
  const torch::Tensor down = DownConv(cells, weight, Normal({layer.out}, 3).to(type));
  const torch::Tensor values = Normal(down.sizes(), 4).to(type).requires_grad_();
  const torch::Tensor up = UpConv(values, weight);
  std::vector<torch::Tensor> results = {down, up};
  for (const auto& [output, input] : {std::array{down, cells}, {up, values}}) {
    const torch::Tensor factor = Normal(output.sizes(), 5).to(type);
    for (const auto& gradient : torch::autograd::grad({(output * factor).sum()}, {input, weight})) {
      results.push_back(gradient);
    }
  }
  return results;
}

TEST(WinogradConv, SuitsGridsOfWholeTilesWithChannelsSideBySide) {
  EXPECT_TRUE(SuitsWinograd({4, 9, 64, 16}));
  EXPECT_FALSE(SuitsWinograd({4, 8, 64, 16})) << "seven outputs along a side";
  EXPECT_FALSE(SuitsWinograd({4, 9, 8, 16})) << "one channel on the grid";
  EXPECT_FALSE(SuitsWinograd({4, 9, 64, 8}));
}

TEST(WinogradConv, IsAsExactAsFloat) {
  for (const Layer& layer : {Layer{2, 16, 16, 32}, {70, 8, 4, 16}, {3, 128, 4, 256}}) {
    const auto actual = Results(layer, torch::kFloat), exact = Results(layer, torch::kDouble);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      EXPECT_LT((actual[i] - exact[i]).abs().max().item<double>(),
                2e-5 * exact[i].abs().max().item<double>())
          << layer.in << " channels, result " << i;
    }
  }
}

TEST(WinogradConv, GivesTheSameBitsWithAnyNumberOfThreads) {
  const int threads_before = at::get_num_threads();
  // More tiles of a sample than a block takes, as many, and fewer; and an odd number of them.
  for (const Layer& layer :
       {Layer{2, 8, 20, 16}, {3, 8, 16, 16}, {21, 24, 8, 16}, {7, 16, 4, 48}}) {
    std::vector<torch::Tensor> first;
    for (const int threads : {1, 2, 3}) {
      at::set_num_threads(threads);
      const auto all = Results(layer, torch::kFloat);
      if (first.empty()) first = all;
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_TRUE(torch::equal(all[i], first[i])) << threads << " threads, result " << i;
      }
    }
  }
  at::set_num_threads(threads_before);
}

}  // namespace
}  // namespace antigrasp
