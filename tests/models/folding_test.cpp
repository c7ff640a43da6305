#include "antigrasp/models/folding.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <array>
#include <utility>

#include "antigrasp/core/pieces.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

torch::Tensor Normal(at::IntArrayRef shape, std::uint64_t stream) {
  RngStream rng(7, "folding_test", stream);
  return NormalTensor(shape, 1.0, &rng);
}

double MaxDifference(const torch::Tensor& a, const torch::Tensor& b) {
  return (a - b).abs().max().item<double>();
}

// [1 2 1]/4 along the three axes as one dense kernel.
torch::Tensor BlurKernel() {
  const torch::Tensor taps = torch::tensor({0.25F, 0.5F, 0.25F});
  return (taps.view({3, 1, 1}) * taps.view({3, 1}) * taps).view({1, 1, 3, 3, 3});
}

TEST(Folding, UnfoldReturnsTheFoldedGridBitForBit) {
  for (const auto& [side, channels] : {std::pair{2, 3}, {4, 1}, {16, 8}, {4, 16}, {32, 3}}) {
    const torch::Tensor grid = Normal({2, channels, side, side, side}, 1);
    const torch::Tensor folded = Fold(grid);
    const std::int64_t h = side / 2 + 1;
    EXPECT_EQ(folded.sizes(), (std::vector<std::int64_t>{2, 8 * channels, h, h, h}));
    EXPECT_TRUE(torch::equal(Unfold(folded), grid));
    EXPECT_DOUBLE_EQ(folded.to(torch::kDouble).abs().sum().item<double>(),
                     grid.to(torch::kDouble).abs().sum().item<double>());  // the ring is zero
  }
}

TEST(Folding, FloatKernelsAgreeWithTheGeneralTensorPath) {
  const torch::Tensor grid = Normal({2, 3, 8, 8, 8}, 2);
  const auto as_double = [](const torch::Tensor& x) { return x.to(torch::kDouble); };
  EXPECT_TRUE(torch::equal(as_double(Fold(grid)), Fold(as_double(grid))));
  for (const std::int64_t h : {5, 17, 33}) {  // of 8^3, 32^3 and 64^3 nodes
    const torch::Tensor folded = Normal({2, 8, h, h, h}, 3);
    EXPECT_TRUE(torch::equal(as_double(Unfold(folded)), Unfold(as_double(folded))));
    EXPECT_TRUE(torch::equal(as_double(BlurAndClearRing(folded, false)),
                             BlurAndClearRing(as_double(folded), false)));
    EXPECT_LT(MaxDifference(as_double(BlurAndClearRing(folded, true)),
                            BlurAndClearRing(as_double(folded), true)),
              1e-6);
  }
}

TEST(Folding, FoldAndUnfoldAreEachOthersGradient) {
  torch::Tensor grid = Normal({1, 2, 4, 4, 4}, 4).requires_grad_();
  const torch::Tensor weight = Normal({1, 16, 3, 3, 3}, 5);
  (Fold(grid) * weight).sum().backward();
  EXPECT_TRUE(torch::equal(grid.grad(), Unfold(weight)));
  torch::Tensor folded = Normal({1, 16, 3, 3, 3}, 6).requires_grad_();
  const torch::Tensor grid_weight = Normal({1, 2, 4, 4, 4}, 7);
  (Unfold(folded) * grid_weight).sum().backward();
  EXPECT_TRUE(torch::equal(folded.grad(), Fold(grid_weight)));
}

TEST(Folding, DownConvEqualsThePlainStridedConvolutionWithItsGradients) {
  for (const auto& [in, out, side] : {std::array{1, 5, 32},
                                      {3, 4, 8},
                                      {6, 2, 4},
                                      // with kernels of our own: 8 k channels
                                      {1, 8, 32},
                                      {3, 16, 8},
                                      {2, 40, 6},
                                      {5, 24, 2},
                                      // by Winograd's scheme
                                      {8, 16, 16},
                                      {16, 32, 4},
                                      {24, 48, 12},
                                      {48, 16, 8}}) {
    std::vector<torch::Tensor> plain = {Normal({2, in, side, side, side}, 8),
                                        Normal({out, in, 4, 4, 4}, 9), Normal({out}, 10)};
    std::vector<torch::Tensor> folded;
    for (torch::Tensor& x : plain) {
      folded.push_back(x.clone().requires_grad_());
      x.requires_grad_();
    }
    const torch::Tensor expected = torch::conv3d(plain[0], plain[1], plain[2], 2, 1);
    const torch::Tensor actual = DownConv(Fold(folded[0]), folded[1], folded[2]);
    const double scale = expected.abs().max().item<double>();
    EXPECT_LT(MaxDifference(actual, expected), 1e-5 * scale);
    const torch::Tensor weight = Normal(expected.sizes(), 11);
    (expected * weight).sum().backward();
    (actual * weight).sum().backward();
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_LT(MaxDifference(folded[i].grad(), plain[i].grad()),
                1e-5 * plain[i].grad().abs().max().item<double>())
          << "gradient " << i;
    }
  }
}

TEST(Folding, UpConvEqualsThePlainTransposedConvolutionWithItsGradients) {
  for (const auto& [in, out, side] : {std::array{5, 1, 16},
                                      {4, 3, 4},
                                      {2, 6, 2},
                                      // with kernels of our own: 8 k channels
                                      {8, 1, 16},
                                      {16, 3, 4},
                                      {40, 2, 3},
                                      {24, 5, 1},
                                      // by Winograd's scheme
                                      {16, 8, 8},
                                      {32, 16, 2},
                                      {48, 24, 6},
                                      {16, 48, 4}}) {
    std::vector<torch::Tensor> plain = {Normal({2, in, side, side, side}, 12),
                                        Normal({in, out, 4, 4, 4}, 13)};
    std::vector<torch::Tensor> folded;
    for (torch::Tensor& x : plain) {
      folded.push_back(x.clone().requires_grad_());
      x.requires_grad_();
    }
    const torch::Tensor expected = torch::conv_transpose3d(plain[0], plain[1], {}, 2, 1);
    const torch::Tensor actual = Unfold(UpConv(folded[0], folded[1]));
    EXPECT_LT(MaxDifference(actual, expected), 1e-5 * expected.abs().max().item<double>());
    const torch::Tensor weight = Normal(expected.sizes(), 15);
    (expected * weight).sum().backward();
    (actual * weight).sum().backward();
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_LT(MaxDifference(folded[i].grad(), plain[i].grad()),
                1e-5 * plain[i].grad().abs().max().item<double>())
          << "gradient " << i;
    }
  }
}

TEST(Folding, FoldLeakyIsFoldOfTheLeakyReluAndSoIsItsGradientBitForBit) {
  for (const std::int64_t channels : {1, 6, 8, 16, 24}) {
    torch::Tensor grid = Normal({3, channels, 4, 4, 4}, 23);
    grid.flatten()[5] = 0.0F;
    grid.requires_grad_();
    const torch::Tensor leaky = FoldLeaky(grid, 0.2), plain = Fold(torch::leaky_relu(grid, 0.2));
    EXPECT_TRUE(torch::equal(leaky, plain)) << channels;
    const torch::Tensor weights = Normal(leaky.sizes(), 24);
    EXPECT_TRUE(torch::equal(torch::autograd::grad({(leaky * weights).sum()}, {grid})[0],
                             torch::autograd::grad({(plain * weights).sum()}, {grid})[0]))
        << channels;
  }
}

TEST(Folding, ConvolutionsGiveTheSameBitsWithAnyNumberOfThreads) {
  std::vector<torch::Tensor> first;
  const int threads_before = PieceThreads();
  for (const int threads : {1, 2, 5}) {
    SetPieceThreads(threads);
    const torch::Tensor folded = Normal({7, 24, 5, 5, 5}, 20).requires_grad_();
    const torch::Tensor weight = Normal({40, 3, 4, 4, 4}, 21).requires_grad_();
    const torch::Tensor down = DownConv(folded, weight, torch::zeros({40}));
    const torch::Tensor up = UpConv(down, weight);
    const auto gradients =
        torch::autograd::grad({(up * Normal(up.sizes(), 22)).sum()}, {folded, weight});
    const std::vector<torch::Tensor> all = {down, up, gradients[0], gradients[1]};
    if (first.empty()) first = all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_TRUE(torch::equal(all[i], first[i])) << threads << " threads, tensor " << i;
    }
  }
  SetPieceThreads(threads_before);
}

TEST(Folding, EmphasizeEdgesSubtractsTheLaplacianOfAGridThatEnds) {
  const torch::Tensor grid = Normal({2, 1, 32, 32, 32}, 21);
  const torch::Tensor edge = torch::replication_pad3d(grid, {1, 1, 1, 1, 1, 1});
  torch::Tensor kernel = torch::zeros({1, 1, 3, 3, 3});
  kernel.index_put_({0, 0, 1, 1, 1}, -6.0F);
  for (const auto& [z, y, x] :
       {std::array{0, 1, 1}, {2, 1, 1}, {1, 0, 1}, {1, 2, 1}, {1, 1, 0}, {1, 1, 2}}) {
    kernel[0][0][z][y][x] = 1.0F;
  }
  const torch::Tensor expected = grid - 1.5 * torch::conv3d(edge, kernel);
  EXPECT_LT(MaxDifference(Unfold(EmphasizeEdges(Fold(grid), 1.5)), expected), 1e-4);
  EXPECT_TRUE(torch::equal(EmphasizeEdges(Fold(grid), 0.0), Fold(grid)));
  const torch::Tensor constant = Fold(torch::full({1, 1, 32, 32, 32}, 0.5));
  EXPECT_TRUE(torch::equal(EmphasizeEdges(constant, 3.0), constant));
}

TEST(Folding, EmphasizeEdgesHasTheBitsOfItsFormulaAxisByAxis) {
  for (const std::int64_t side : {2, 4, 32}) {
    const torch::Tensor grid = Normal({3, 1, side, side, side}, 11);
    torch::Tensor expected = grid.clone();
    for (std::int64_t axis = 2; axis < 5; ++axis) {
      const torch::Tensor step = 1.3 * (grid.slice(axis, 1, side) - grid.slice(axis, 0, side - 1));
      expected.slice(axis, 0, side - 1).sub_(step);
      expected.slice(axis, 1, side).add_(step);
    }
    EXPECT_TRUE(torch::equal(EmphasizeEdges(Fold(grid), 1.3), Fold(expected))) << side;
  }
}

TEST(Folding, EmphasizeEdgesIsItsOwnTranspose) {
  torch::Tensor folded = Fold(Normal({1, 1, 32, 32, 32}, 22)).requires_grad_();
  const torch::Tensor weight = Fold(Normal({1, 1, 32, 32, 32}, 23));
  (EmphasizeEdges(folded, 2.0) * weight).sum().backward();
  EXPECT_LT(MaxDifference(folded.grad(), EmphasizeEdges(weight, 2.0)), 1e-5);
}

TEST(Folding, BlurIsTheBinomialFilterOfTheUncroppedOutput) {
  const torch::Tensor x = Normal({2, 3, 16, 16, 16}, 16), weight = Normal({3, 1, 4, 4, 4}, 17);
  const torch::Tensor uncropped = torch::conv_transpose3d(x, weight, {}, 2, 0);  // 34^3
  const torch::Tensor expected = torch::conv3d(uncropped, BlurKernel(), {}, 1, 1)
                                     .slice(2, 1, 33)
                                     .slice(3, 1, 33)
                                     .slice(4, 1, 33);
  const torch::Tensor actual = BlurAndClearRing(UpConv(x, weight), true);
  EXPECT_LT(MaxDifference(Unfold(actual), expected), 1e-5);
  EXPECT_TRUE(torch::equal(Fold(Unfold(actual)), actual)) << "the ring is not zero";
}

TEST(Folding, BlurKeepsAConstantInsideAndItsGradientIsItsTranspose) {
  const torch::Tensor ones = torch::ones({1, 8, 17, 17, 17});
  EXPECT_TRUE(torch::equal(Unfold(BlurAndClearRing(ones, true)), torch::ones({1, 1, 32, 32, 32})));
  torch::Tensor x = Normal({1, 8, 17, 17, 17}, 18).requires_grad_();
  const torch::Tensor y = Normal({1, 8, 17, 17, 17}, 19);
  const torch::Tensor product = (BlurAndClearRing(x, true) * y).sum();  // <P B x, y>
  product.backward();
  EXPECT_NEAR((x * x.grad()).sum().item<double>(), product.item<double>(), 1e-2);  // <x, B P y>
}

}  // namespace
}  // namespace antigrasp
