#include "antigrasp/models/turned_outline.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>

#include <cmath>
#include <vector>

#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

constexpr double kRoom = 0.4375;
constexpr int kFrusta = 3;

// All 0 but for what is set: numbers of the base (k = 0) and the frusta, upwards.
enum Number { kRise, kWiden, kRound, kSkew };
struct Numbers {
  torch::Tensor all = torch::zeros({1, OutlineNumbers(kFrusta)});
  void Set(int k, Number number, double value) { all[0][4 * k + number] = value; }
};

torch::Tensor Sharp(Numbers numbers) {  // -> points, one of each corner's nine
  for (int k = 0; k <= kFrusta; ++k) numbers.Set(k, kRound, -9.0);
  const torch::Tensor outline = Outlines(numbers.all, kFrusta, kRoom)[0];
  EXPECT_EQ(outline.size(0), 2 + 9 * (kFrusta + 3));
  std::vector<torch::Tensor> corners = {outline[0]};
  for (int k = 0; k < kFrusta + 3; ++k) corners.push_back(outline[1 + 9 * k + 4]);
  corners.push_back(outline[outline.size(0) - 1]);
  return torch::stack(corners);
}

void ExpectPoint(const torch::Tensor& point, double radius, double z) {
  EXPECT_NEAR(point[0].item<double>(), radius, 1e-6);
  EXPECT_NEAR(point[1].item<double>(), z, 1e-6);
}

// Corners of a polygon with one bend of 90 degrees at (0.2, 0), pieces 0.2 and 0.1 long.
torch::Tensor Bend() { return torch::tensor({0.0F, 0.0F, 0.2F, 0.0F, 0.2F, 0.1F}).view({1, 3, 2}); }

TEST(TurnedOutline, OfNothingDrawnIsACylinderOnAHollowBase) {
  const torch::Tensor corners = Sharp({});
  // Three frusta rise by 0.07 - 0.01, the top one by 0.06 more.
  const double half = 0.5 * (3 * 0.06 + 0.06);
  ExpectPoint(corners[0], 0.0, -half + 0.021);  // the hollow: 0.03 - 0.009 deep
  ExpectPoint(corners[3], 0.2, -half);
  ExpectPoint(corners[4], 0.2, -half + 0.06);
  ExpectPoint(corners[5], 0.2, -half + 0.12);
  ExpectPoint(corners[6], 0.2, half);
  ExpectPoint(corners[7], 0.0, half);
}

TEST(TurnedOutline, EveryNumberHasAnEffectOfItsOwn) {
  Numbers numbers;
  numbers.Set(0, kRise, -9.0);   // no hollow
  numbers.Set(2, kRise, -9.0);   // a step
  numbers.Set(2, kWiden, -1.0);  // inward
  const torch::Tensor corners = Sharp(numbers);
  const double half = 0.5 * (2 * 0.06 + 0.06);
  const double narrow = 0.2 * std::exp(-(1.6 * std::tanh(0.5 / 1.6) - 0.02));
  ExpectPoint(corners[0], 0.0, -half);
  ExpectPoint(corners[2], 0.11, -half);  // the rim of the hollow: .55 of the radius
  ExpectPoint(corners[4], 0.2, -half + 0.06);
  ExpectPoint(corners[5], narrow, -half + 0.06);
  ExpectPoint(corners[6], narrow, half);
}

TEST(TurnedOutline, WallsThatLeanALittleAreUpright) {
  Numbers numbers;
  numbers.Set(1, kWiden, 0.039);
  numbers.Set(2, kWiden, -0.039);
  const torch::Tensor radius = Sharp(numbers).narrow(0, 3, 4).select(1, 0);
  EXPECT_TRUE(torch::equal(radius, radius[0].expand({4})));
}

TEST(TurnedOutline, WhatIsTooHighIsScaledAsAWhole) {
  Numbers numbers;
  for (int k = 1; k <= kFrusta; ++k) numbers.Set(k, kRise, 9.0);
  const torch::Tensor corners = Sharp(numbers);
  const double rise = 0.07 * std::exp(2.0 * std::tanh(4.5)) - 0.01, height = 3 * rise + 0.06;
  const double scale = 2.0 * kRoom / height;
  ExpectPoint(corners[3], 0.2 * scale, -kRoom);
  ExpectPoint(corners[4], 0.2 * scale, -kRoom + rise * scale);
  ExpectPoint(corners[6], 0.2 * scale, kRoom);
  ExpectPoint(corners[0], 0.0, -kRoom + 0.021 * scale);
}

TEST(TurnedOutline, IsUsableWhateverIsDrawn) {
  for (const double sd : {1.0, 4.0, 1e4}) {
    RngStream rng(3, "turned_outline_test");
    torch::Tensor numbers = NormalTensor({64, OutlineNumbers(kFrusta)}, sd, &rng);
    numbers.set_requires_grad(true);
    const torch::Tensor outlines = Outlines(numbers, kFrusta, kRoom);
    const torch::Tensor gradient = torch::autograd::grad({outlines.square().sum()}, {numbers})[0];
    EXPECT_TRUE(torch::isfinite(gradient).all().item<bool>()) << sd;
    const torch::Tensor radius = outlines.select(2, 0), z = outlines.select(2, 1);
    EXPECT_GE(radius.min().item<double>(), 0.0);
    EXPECT_LT(radius.max().item<double>(), kRoom + 1e-6);
    EXPECT_LT(z.abs().max().item<double>(), kRoom + 1e-6);
    EXPECT_EQ(radius.select(1, 0).abs().max().item<double>(), 0.0);
    EXPECT_EQ(radius.select(1, outlines.size(1) - 1).abs().max().item<double>(), 0.0);
    // The walls, from the first corner's last point to the last corner's first, never fall.
    const std::int64_t first = 1 + 9 * 3 - 1, last = 1 + 9 * (kFrusta + 2);
    const torch::Tensor rise =
        z.narrow(1, first + 1, last - first) - z.narrow(1, first, last - first);
    EXPECT_GT(rise.min().item<double>(), -1e-6);
    EXPECT_GT(radius.narrow(1, first, last - first + 1).min().item<double>(), 0.03 - 1e-6);
    EXPECT_GT((z.select(1, outlines.size(1) - 1) - z.amin(1)).min().item<double>(), 0.06 - 1e-6);
    EXPECT_LT((z.amax(1) + z.amin(1)).abs().max().item<double>(), 1e-6);  // in the middle
  }
}

TEST(RoundedCorners, AreParabolasBetweenTheTwoPieces) {
  const torch::Tensor half = torch::full({1, 1}, 0.5), none = torch::zeros({1, 1});
  const torch::Tensor outline = RoundedCorners(Bend(), half, none)[0];
  ASSERT_EQ(outline.size(0), 11);
  ExpectPoint(outline[0], 0.0, 0.0);
  ExpectPoint(outline[1], 0.15, 0.0);       // half of the shorter piece before the corner
  ExpectPoint(outline[5], 0.1875, 0.0125);  // a quarter, half and quarter of its three points
  ExpectPoint(outline[9], 0.2, 0.05);
  ExpectPoint(outline[10], 0.2, 0.1);
}

TEST(RoundedCorners, BeginFartherAheadThanBehindWhereTheyAreSkew) {
  const torch::Tensor share = torch::full({1, 1}, 0.2), skew = torch::full({1, 1}, std::log(2.0));
  const torch::Tensor outline = RoundedCorners(Bend(), share, skew)[0];
  ExpectPoint(outline[1], 0.19, 0.0);
  ExpectPoint(outline[9], 0.2, 0.04);
}

TEST(RoundedCorners, WithoutRoundingAreSharp) {
  const torch::Tensor none = torch::zeros({1, 1});
  const torch::Tensor outline = RoundedCorners(Bend(), none, none)[0];
  for (int i = 1; i <= 9; ++i) ExpectPoint(outline[i], 0.2, 0.0);
}

TEST(RoundedCorners, OfTwoThatWantMoreThanAPieceEachTakesItsShare) {
  // A step up of 0.1 between two level pieces of 0.2: both corners ask for all of it.
  const torch::Tensor step =
      torch::tensor({0.0F, 0.0F, 0.2F, 0.0F, 0.2F, 0.1F, 0.4F, 0.1F}).view({1, 4, 2});
  const torch::Tensor outline =
      RoundedCorners(step, torch::tensor({{1.0, 0.5}}, torch::kFloat), torch::zeros({1, 2}))[0];
  ExpectPoint(outline[1], 0.1, 0.0);
  ExpectPoint(outline[9], 0.2, 0.1 / 1.5);   // 1 of 1.5
  ExpectPoint(outline[10], 0.2, 0.1 / 1.5);  // 0.5 of 1.5 from the other side: where the first ends
  ExpectPoint(outline[18], 0.25, 0.1);
}

}  // namespace
}  // namespace antigrasp
