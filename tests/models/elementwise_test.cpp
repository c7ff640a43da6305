#include "antigrasp/models/elementwise.h"

#include <ATen/ATen.h>
#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <functional>
#include <vector>

#include "antigrasp/core/pieces.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/slices.h"

namespace antigrasp {
namespace {

torch::Tensor Drawn(at::IntArrayRef shape, std::uint64_t seed) {
  RngStream rng(seed, "elementwise test");
  return NormalTensor(shape, 1.0, &rng);
}

using Op = std::function<torch::Tensor(const std::vector<torch::Tensor>&)>;

// Values and gradients by all inputs that want one, bit for bit, on one thread and on three.
void ExpectTheBits(const std::vector<torch::Tensor>& inputs, const Op& ours, const Op& libtorch) {
  const int before = PieceThreads();
  std::vector<torch::Tensor> wanted;
  for (const torch::Tensor& input : inputs) {
    if (input.requires_grad()) wanted.push_back(input);
  }
  const auto all = [&](const Op& op) {
    std::vector<torch::Tensor> results = {op(inputs)};
    const torch::Tensor weights = Drawn(results[0].sizes(), 9);
    for (const auto& g : torch::autograd::grad({(results[0] * weights).sum()}, wanted)) {
      results.push_back(g);
    }
    return results;
  };
  const auto expected = all(libtorch);
  for (const int threads : {1, 3}) {
    SetPieceThreads(threads);
    const auto found = all(ours);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_TRUE(torch::equal(found[i], expected[i])) << threads << " threads, result " << i;
    }
  }
  SetPieceThreads(before);
}

TEST(Elementwise, TanhIsThatOfLibTorch) {
  const Op ours = [](const auto& in) { return Tanh(in[0]); };
  const Op libtorch = [](const auto& in) { return in[0].tanh(); };
  ExpectTheBits({Drawn({3 * kSlice + 5}, 1).requires_grad_()}, ours, libtorch);
  const torch::Tensor grids = Drawn({5, 8, 17, 17, 17}, 2).contiguous(kChannelsLast);
  ExpectTheBits({grids.requires_grad_()}, ours, libtorch);
}

TEST(Elementwise, AddNumberIsThatOfLibTorch) {
  const torch::Tensor grids = Drawn({5, 8, 17, 17, 17}, 3).contiguous(kChannelsLast);
  ExpectTheBits(
      {grids.requires_grad_(), Drawn({1}, 4).requires_grad_()},
      [](const auto& in) { return AddNumber(in[0], in[1]); },
      [](const auto& in) { return in[0] + in[1]; });
}

TEST(Elementwise, DivideBySigmaIsTheQuotientAndGoesThroughSigma) {
  const Op ours = [](const auto& in) { return DivideBySigma(in[0], in[1], in[2], 1e-12); };
  const Op libtorch = [](const auto& in) {
    return in[0] / in[1].dot(in[0].flatten(1).mv(in[2])).clamp_min(1e-12);
  };
  for (const std::int64_t rows : {1, 7, 64}) {
    const torch::Tensor weight = Drawn({rows, 24, 4, 4, 4}, 5).requires_grad_();
    ExpectTheBits({weight, Drawn({rows}, 6).abs(), weight.detach().sum(0).flatten()}, ours,
                  libtorch);
  }
  // Where sigma is held up it is constant.
  const torch::Tensor weight = torch::full({2, 1, 4, 4, 4}, 0.5F).requires_grad_();
  const torch::Tensor quotient = DivideBySigma(weight, torch::ones({2}), -torch::ones({64}), 0.25);
  EXPECT_TRUE(torch::equal(quotient, torch::full_like(quotient, 2.0F)));
  const torch::Tensor gradient = torch::autograd::grad({quotient.sum()}, {weight})[0];
  EXPECT_TRUE(torch::equal(gradient, torch::full_like(gradient, 4.0F)));
}

TEST(Elementwise, StackedIsOneBehindTheOther) {
  const torch::Tensor a = Drawn({2, 8, 5, 5, 5}, 7).contiguous(kChannelsLast);
  const torch::Tensor b = Drawn({3, 8, 5, 5, 5}, 8);  // lies otherwise
  const torch::Tensor stacked = Stacked(a, b);
  EXPECT_TRUE(torch::equal(stacked, torch::cat({a, b})));
  EXPECT_TRUE(stacked.is_contiguous(kChannelsLast));
}

TEST(Slices, CoverTheMemoryOfTensorsThatLieAlikeAndTakeOthersWhole) {
  const torch::Tensor x = Drawn({2 * kSlice + 3}, 10), y = torch::empty_like(x);
  std::vector<std::int64_t> lengths;
  const int before = PieceThreads();
  SetPieceThreads(1);
  OnSlices<2>({y, x}, [&](auto s) {
    lengths.push_back(s[0].numel());
    s[0].copy_(s[1]);
  });
  EXPECT_EQ(lengths, (std::vector<std::int64_t>{kSlice, kSlice, 3}));
  EXPECT_TRUE(torch::equal(x, y));
  const torch::Tensor turned = Drawn({4, 6}, 11).t(), straight = torch::empty({6, 4});
  OnSlices<2>({straight, turned}, [](auto s) { s[0].copy_(s[1]); });
  EXPECT_TRUE(torch::equal(straight, turned));
  SetPieceThreads(before);
}

}  // namespace
}  // namespace antigrasp
