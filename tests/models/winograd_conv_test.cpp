#include "antigrasp/models/winograd_conv.h"

#include <ATen/ATen.h>
#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <array>

#include "antigrasp/core/pieces.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/winograd_products.h"

namespace antigrasp {
namespace {

torch::Tensor Gaussian(at::IntArrayRef shape, std::uint64_t stream) {
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
      Gaussian({layer.count, 8 * layer.in, h, h, h}, 1).to(type).requires_grad_();
  const torch::Tensor weight =
      Gaussian({layer.out, layer.in, 4, 4, 4}, 2).to(type).requires_grad_();
  const torch::Tensor down = DownConv(cells, weight, Gaussian({layer.out}, 3).to(type));
  const torch::Tensor values = Gaussian(down.sizes(), 4).to(type).requires_grad_();
  const torch::Tensor up = UpConv(values, weight);
  std::vector<torch::Tensor> results = {down, up};
  for (const auto& [output, input] : {std::array{down, cells}, {up, values}}) {
    const torch::Tensor factor = Gaussian(output.sizes(), 5).to(type);
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
  if (!HasCellConv()) GTEST_SKIP() << "no AVX2: LibTorch's convolutions do the work";
  const int threads_before = PieceThreads();
  // More tiles of a sample than a block takes, as many, and fewer; and an odd number of them.
  for (const Layer& layer :
       {Layer{2, 8, 20, 16}, {3, 8, 16, 16}, {21, 24, 8, 16}, {7, 16, 4, 48}}) {
    std::vector<torch::Tensor> first;
    for (const int threads : {1, 2, 3}) {
      SetPieceThreads(threads);
      const auto all = Results(layer, torch::kFloat);
      if (first.empty()) first = all;
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_TRUE(torch::equal(all[i], first[i])) << threads << " threads, result " << i;
      }
    }
  }
  SetPieceThreads(threads_before);
}

// Of every sample in turn what goes through the whole batch otherwise.
TEST(WinogradConv, SamplesThatPassFoldingAndConvolutionTogetherKeepTheirBits) {
  if (!HasCellConv()) GTEST_SKIP() << "no AVX2: LibTorch's convolutions do the work";
  const int threads_before = PieceThreads();
  RngStream rng(3, "sample by sample");
  const std::int64_t count = 35;  // 8 at a time, and 3
  const torch::Tensor grid = NormalTensor({count, 16, 8, 8, 8}, 1.0, &rng).requires_grad_();
  const torch::Tensor x = NormalTensor({count, 16, 4, 4, 4}, 1.0, &rng).requires_grad_();
  const torch::Tensor weight = NormalTensor({16, 16, 4, 4, 4}, 1.0, &rng).requires_grad_();
  const torch::Tensor bias = NormalTensor({16}, 1.0, &rng).requires_grad_();
  const torch::Tensor down_weights = NormalTensor({count, 16, 4, 4, 4}, 1.0, &rng);
  const torch::Tensor up_weights = NormalTensor({count, 16, 8, 8, 8}, 1.0, &rng);
  const auto results = [&](const torch::Tensor& down, const torch::Tensor& up) {
    std::vector<torch::Tensor> all = {down, up};
    for (const auto& g : torch::autograd::grad({(down * down_weights).sum()}, {grid, weight, bias}))
      all.push_back(g);
    for (const auto& g : torch::autograd::grad({(up * up_weights).sum()}, {x, weight}))
      all.push_back(g);
    return all;
  };
  SetPieceThreads(1);
  const auto expected =
      results(DownConv(FoldLeaky(grid, 0.2), weight, bias), Unfold(UpConv(x, weight)));
  for (const int threads : {1, 2}) {
    SetPieceThreads(threads);
    ASSERT_TRUE(SuitsSampleBySample({count, 5, 128, 16}));
    const auto found = results(DownConvLeaky(grid, 0.2, weight, bias), UpConvUnfolded(x, weight));
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_TRUE(torch::equal(found[i], expected[i])) << threads << " threads, result " << i;
    }
  }
  EXPECT_FALSE(SuitsSampleBySample({15, 5, 128, 16}));    // too few for two threads
  EXPECT_FALSE(SuitsSampleBySample({64, 3, 1024, 128}));  // a block of tiles fills no cache
  SetPieceThreads(threads_before);
}

#ifdef __x86_64__  // elsewhere neither kernel is there

// Whole rounds of rows and pairs of panels, and others.
TEST(WinogradConv, ItsAvx512KernelGivesTheBitsOfItsAvx2Kernel) {
  if (!__builtin_cpu_supports("avx512f")) GTEST_SKIP() << "no AVX-512";
  constexpr std::int64_t kDepth = 24, kPanel = winograd::kPanel;
  for (const std::int64_t rows : {4, 8, 12, 60, 64}) {
    for (const std::int64_t width : {16, 32, 48}) {
      const torch::Tensor left = Gaussian({rows, kDepth}, 1);
      const torch::Tensor right = Gaussian({width / kPanel, kDepth, kPanel}, 2);
      for (const bool first : {true, false}) {
        const torch::Tensor before = Gaussian({rows, width}, 3);
        torch::Tensor narrow = before.clone(), wide = before.clone();
        winograd::ProductBlock block = {rows,
                                        kDepth,
                                        width,
                                        left.data_ptr<float>(),
                                        kDepth,
                                        1,
                                        right.data_ptr<float>(),
                                        kDepth * kPanel,
                                        narrow.data_ptr<float>(),
                                        width,
                                        kPanel,
                                        first};
        winograd::AddProductsAvx2(block);
        block.sums = wide.data_ptr<float>();
        winograd::AddProductsAvx512(block);
        EXPECT_TRUE(torch::equal(narrow, wide)) << rows << " x " << width;
        torch::Tensor exact = left.matmul(right.permute({1, 0, 2}).reshape({kDepth, width}));
        if (!first) exact = exact + before;
        EXPECT_LT((wide - exact).abs().max().item<double>(), 1e-4) << rows << " x " << width;
      }
    }
  }
}

#endif

}  // namespace
}  // namespace antigrasp
