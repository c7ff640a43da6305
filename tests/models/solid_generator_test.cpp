#include "antigrasp/models/solid_generator.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "antigrasp/models/folding.h"
#include "antigrasp/models/largest_piece.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/models/solid_field.h"
#include "antigrasp/models/turned_field.h"

namespace antigrasp {
namespace {

ModelOptions Solids() {
  ModelOptions options;
  options.kind = ModelKind::kSolids;
  options.parts = 3;
  options.width = 2;
  options.latent = 5;
  return options;
}

torch::Tensor Noise(std::int64_t count, double sd) {
  RngStream rng(3, "solid_generator_test");
  return NormalTensor({count, 5}, sd, &rng);
}

TEST(SolidGenerator, DrawsTheUnionOfItsPartsAsNetworkValues) {
  const ModelOptions options = Solids();
  SolidGenerator generator(options);
  const torch::Tensor z = Noise(4, 1.0), grids = generator(z);
  ASSERT_EQ(grids.sizes(), (std::vector<std::int64_t>{4, 1, 32, 32, 32}));
  EXPECT_TRUE(torch::equal(
      grids, NetworkValues(SolidField(generator->Parts(z), options.resolution), options)));
  EXPECT_TRUE(torch::equal(generator->ForwardJudged(z), Fold(grids)));
}

TEST(SolidGenerator, FirstShapesAreSolidAndOfManyForms) {
  ModelOptions options = Solids();
  options.width = 8;
  SolidGenerator generator(options);
  const torch::Tensor inside = (generator(Noise(16, 1.0)) > 0).to(torch::kFloat).flatten(1).mean(1);
  EXPECT_GT(inside.min().item<double>(), 0.01);
  EXPECT_LT(inside.max().item<double>(), 0.7);
  EXPECT_GT(inside.std().item<double>(), 0.01);
}

TEST(SolidGenerator, PartsAreUsableWhateverIsDrawn) {
  SolidGenerator generator(Solids());
  for (const double sd : {1.0, 1e4}) {
    const torch::Tensor parts = generator->Parts(Noise(64, sd)).flatten(0, 1);
    EXPECT_TRUE(torch::isfinite(parts).all().item<bool>());
    const torch::Tensor axes = parts.narrow(1, kPartAxes, 9).view({-1, 3, 3});
    const torch::Tensor turned_back = torch::matmul(axes, axes.transpose(1, 2));
    EXPECT_LT((turned_back - torch::eye(3)).abs().max().item<double>(), 1e-4);
    const torch::Tensor half = parts.narrow(1, kPartHalf, 3);
    EXPECT_GT(half.min().item<double>(), 0.0299);  // two cells of 32^3 thick
    const torch::Tensor round = parts.select(1, kPartRound);
    EXPECT_GE(round.min().item<double>(), 0.0);
    EXPECT_LE(round.max().item<double>(), 1.0);
    const torch::Tensor lean = parts.narrow(1, kPartLean, 2).abs() * half.narrow(1, 2, 1);
    EXPECT_GT((half.narrow(1, 0, 2) - lean).min().item<double>(), 0.0299);  // nor its narrow end
    EXPECT_TRUE((parts.select(1, kPartFillet) <= 0.5 * half.amin(1) + 1e-7).all().item<bool>());
  }
}

TEST(SolidGenerator, NothingTouchesTheBorderWhateverIsDrawn) {
  ModelOptions options = Solids();
  SolidGenerator generator(options);
  for (const double sd : {1.0, 3.0, 1e4}) {
    const torch::Tensor grids = generator(Noise(64, sd));
    for (int axis = 2; axis < 5; ++axis) {
      for (const int side : {0, 31}) {
        EXPECT_LT(grids.select(axis, side).max().item<double>(), 0.0);
      }
    }
  }
}

TEST(SolidGenerator, EveryPartMeetsTheOneBefore) {
  ModelOptions options = Solids();
  options.parts = 4;
  SolidGenerator generator(options);
  for (const double sd : {1.0, 3.0}) {
    const torch::Tensor parts = generator->Parts(Noise(64, sd));
    int apart = 0;  // no node within both or a node's distance of them
    for (std::int64_t k = 1; k < options.parts; ++k) {
      const torch::Tensor both = torch::minimum(SolidField(parts.narrow(1, k - 1, 1), 32),
                                                SolidField(parts.narrow(1, k, 1), 32));
      apart += (both.flatten(1).amax(1) <= -0.028).sum().item<int>();
    }
    EXPECT_EQ(apart, 0) << "of 192";
  }
}

// The last layer alone speaks: its biases [parts, 19], all 0.
torch::Tensor Biases(SolidGenerator* generator) {
  torch::NoGradGuard no_grad;
  for (torch::Tensor& parameter : (*generator)->parameters()) parameter.zero_();
  return (*generator)->named_parameters()["layer4.bias"].view({3, 19});
}

TEST(SolidGenerator, NeedlesHangEndToEndWhereTheirJointsAreAtTheirEnds) {
  SolidGenerator generator(Solids());
  torch::NoGradGuard no_grad;
  torch::Tensor bias = Biases(&generator);
  bias.select(1, 3).fill_(-4.0);                    // thin along u and v
  bias.select(1, 2).narrow(0, 1, 2).fill_(50.0);    // on the upper end of the one before,
  bias.select(1, 14).narrow(0, 1, 2).fill_(-50.0);  // by the lower end
  const torch::Tensor parts = generator->Parts(Noise(1, 1.0))[0];
  const double half = parts[0][kPartHalf + 2].item<double>();
  EXPECT_NEAR(half, 0.15, 1e-6);
  for (int k = 0; k < 3; ++k) {  // the middle one in the cube's middle
    EXPECT_NEAR(parts[k][kPartCentre + 2].item<double>(), 2.0 * 0.9 * half * (k - 1), 1e-6) << k;
    EXPECT_NEAR(parts[k][kPartCentre].item<double>(), 0.0, 1e-6) << k;
  }
}

TEST(SolidGenerator, TheBoundingBoxIsInTheMiddleOfTheCube) {
  SolidGenerator generator(Solids());
  const torch::Tensor inside = generator(Noise(64, 1.0)) > 0;
  for (int i = 0; i < 64; ++i) {
    const torch::Tensor nodes = inside[i][0].nonzero();  // [n, 3]
    const torch::Tensor ends =
        std::get<0>(nodes.min(0)) + std::get<0>(nodes.max(0)) - 31;  // 0 where a middle is
    // Each side ends within a node's distance of the last node inside.
    EXPECT_LE(ends.abs().max().item<int>(), 1) << i;
  }
}

TEST(SolidGenerator, WhatIsTooLargeIsScaledAsAWhole) {
  SolidGenerator generator(Solids());
  torch::NoGradGuard no_grad;
  torch::Tensor bias = Biases(&generator);
  bias.select(1, 5).fill_(2.0);                   // long along w
  bias.select(1, 2).narrow(0, 1, 2).fill_(50.0);  // end to end, as the needles
  bias.select(1, 14).narrow(0, 1, 2).fill_(-50.0);
  const torch::Tensor parts = generator->Parts(Noise(1, 1.0))[0];
  // Half w before, others 0.15; 2 (1 + 2 * 0.9) half w long in all.
  const double before = 0.03 + 0.12 * std::exp(1.3 * std::tanh(1.0 / 1.3)), after = 0.4375 / 2.8;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(parts[k][kPartHalf + 2].item<double>(), after, 1e-6);
    EXPECT_NEAR(parts[k][kPartHalf].item<double>(), 0.15 * after / before, 1e-6);
    EXPECT_NEAR(parts[k][kPartCentre + 2].item<double>(), 1.8 * after * (k - 1), 1e-6);
  }
}

TEST(SolidGenerator, SlightTurnsAreNone) {
  SolidGenerator generator(Solids());
  torch::NoGradGuard no_grad;
  torch::Tensor bias = Biases(&generator);
  bias[0].narrow(0, 6, 6).copy_(torch::tensor({0.0, 0.5, -0.5, 0.4, 0.0, 0.5}));  // 0.954 in all
  bias[1].narrow(0, 6, 6).copy_(torch::tensor({0.0, 2.0, 0.0, 0.0, 0.0, 0.0}));
  const torch::Tensor axes =
      generator->Parts(Noise(1, 1.0))[0].narrow(1, kPartAxes, 9).view({3, 3, 3});
  EXPECT_TRUE(torch::equal(axes[0], torch::eye(3)));
  EXPECT_NEAR(axes[1][0][1].item<double>(), std::sqrt(0.5), 1e-6);  // u: (1, 2 - 1, 0), of length 1
}

TEST(SolidGenerator, InEvaluationWhatDoesNotHangTogetherIsLeftOut) {
  SolidGenerator generator(Solids());
  const torch::Tensor z = Noise(64, 1.0), drawn = generator(z);
  generator->eval();
  const torch::Tensor kept = generator(z);
  EXPECT_TRUE(torch::equal(kept, LargestPiece(drawn)));
  EXPECT_FALSE(torch::equal(kept, drawn)) << "no shape of 64 had a second piece";
}

TEST(SolidGenerator, SlightLeansAreUprightAndSlightlyUnequalSidesEqual) {
  SolidGenerator generator(Solids());
  torch::NoGradGuard no_grad;
  torch::Tensor bias = Biases(&generator);
  bias.select(1, 4).fill_(0.19);   // sides
  bias.select(1, 16).fill_(0.24);  // lean along u
  bias.select(1, 17).fill_(-0.4);  // lean along v, the other way
  const torch::Tensor parts = generator->Parts(Noise(1, 1.0))[0];
  EXPECT_TRUE(torch::equal(parts.select(1, kPartHalf), parts.select(1, kPartHalf + 1)));
  EXPECT_EQ(parts.select(1, kPartLean).abs().max().item<double>(), 0.0);
  EXPECT_LT(parts.select(1, kPartLean + 1).max().item<double>(), -0.01);
}

TEST(SolidGenerator, CylindersBeginRoundAndMostlyOfEqualSides) {
  ModelOptions options = Solids();
  options.width = 8;
  options.form = PartForm::kCylinders;
  SolidGenerator generator(options);
  const torch::Tensor parts = generator->Parts(Noise(64, 1.0)).flatten(0, 1);
  EXPECT_GT((parts.select(1, kPartRound) == 1.0).to(torch::kFloat).mean().item<double>(), 0.9);
  const torch::Tensor u = parts.select(1, kPartHalf), v = parts.select(1, kPartHalf + 1);
  EXPECT_GT((u == v).to(torch::kFloat).mean().item<double>(), 0.6);
  torch::NoGradGuard no_grad;
  Biases(&generator).select(1, 15).fill_(-9.0);  // they may become boxes
  EXPECT_EQ(generator->Parts(Noise(8, 0.0)).select(2, kPartRound).max().item<double>(), 0.0);
}

ModelOptions Turned() {
  ModelOptions options = Solids();
  options.form = PartForm::kTurned;
  options.parts = 6;
  return options;
}

TEST(SolidGenerator, TurnedSolidsAreTheInsidesOfTheirOutlines) {
  SolidGenerator generator(Turned());
  const torch::Tensor z = Noise(4, 1.0), grids = generator(z);
  ASSERT_EQ(grids.sizes(), (std::vector<std::int64_t>{4, 1, 32, 32, 32}));
  EXPECT_TRUE(
      torch::equal(grids, NetworkValues(TurnedField(generator->Outlines(z), 32), Turned())));
  EXPECT_TRUE(torch::equal(grids, grids.transpose(3, 4)));
  EXPECT_THROW(generator->Parts(z), std::logic_error);
  EXPECT_THROW(SolidGenerator(Solids())->Outlines(z), std::logic_error);
}

TEST(SolidGenerator, TurnedSolidsAreWhatTheirStandardisedNumbersStandFor) {
  torch::NoGradGuard no_grad;
  SolidGenerator generator(Turned());
  const std::int64_t n = generator->PartNumbers();
  const torch::Tensor z = Noise(4, 1.0), drawn = generator->ForwardJudged(z);
  const torch::Tensor mean = torch::linspace(-0.5, 0.4, n),
                      deviation = torch::linspace(0.2, 0.9, n);
  generator->Standardise(mean, deviation);
  EXPECT_TRUE(torch::equal(generator->ForwardJudged(z), drawn));
  EXPECT_TRUE(torch::equal(generator(z), generator->OfNumbers(mean + deviation * drawn)));
  RngStream rng(3, "again");
  generator->Initialize(&rng);  // forgets them
  EXPECT_TRUE(torch::equal(generator(z), generator->OfNumbers(generator->ForwardJudged(z))));
}

TEST(SolidGenerator, TurnedSolidsAreInTheMiddleAndOfManyForms) {
  ModelOptions options = Turned();
  options.width = 8;
  SolidGenerator generator(options);
  const torch::Tensor inside = generator(Noise(64, 1.0)) > 0;
  const torch::Tensor share = inside.to(torch::kFloat).flatten(1).mean(1);
  EXPECT_GT(share.min().item<double>(), 0.001);
  EXPECT_GT(share.std().item<double>(), 0.01);
  for (int i = 0; i < 64; ++i) {
    const torch::Tensor nodes = inside[i][0].nonzero();
    const torch::Tensor ends = std::get<0>(nodes.min(0)) + std::get<0>(nodes.max(0)) - 31;
    EXPECT_LE(ends.abs().max().item<int>(), 1) << i;
  }
  for (const double sd : {3.0, 1e4}) {  // nor do they touch the border
    const torch::Tensor grids = generator(Noise(64, sd));
    for (int axis = 2; axis < 5; ++axis) {
      EXPECT_LT(grids.select(axis, 0).max().item<double>(), 0.0);
      EXPECT_LT(grids.select(axis, 31).max().item<double>(), 0.0);
    }
  }
}

void ExpectAddsWhatIsBehindZ(const ModelOptions& options, std::int64_t numbers) {
  SolidGenerator generator(options);
  ASSERT_EQ(generator->PartNumbers(), numbers);
  const torch::Tensor z = Noise(4, 1.0), none = torch::zeros({4, numbers});
  EXPECT_TRUE(torch::equal(generator(torch::cat({z, none}, 1)), generator(z)));
  RngStream rng(4, "solid_generator_test");
  const torch::Tensor moved = NormalTensor({1, numbers}, 1.0, &rng);
  const torch::Tensor drawn = generator(torch::cat({z, moved.expand({4, -1})}, 1));
  torch::NoGradGuard no_grad;  // as biases of the last layer would be
  generator->named_parameters()["layer4.bias"].add_(moved[0]);
  EXPECT_LT((drawn - generator(z)).abs().max().item<double>(), 1e-4);
}

TEST(SolidGenerator, NumbersBehindZAreAddedToWhatItDraws) {
  ExpectAddsWhatIsBehindZ(Solids(), 3 * 19);
  ExpectAddsWhatIsBehindZ(Turned(), 4 * 7 + 1);  // of the base and six frusta, and one more
}

TEST(SolidGenerator, WeightsDependOnTheStreamOnly) {
  SolidGenerator a(Solids()), b(Solids());
  RngStream one(1, "a"), same(1, "a"), other(2, "a");
  a->Initialize(&one);
  b->Initialize(&same);
  EXPECT_TRUE(torch::equal(a(Noise(1, 1.0)), b(Noise(1, 1.0))));
  b->Initialize(&other);
  EXPECT_FALSE(torch::equal(a(Noise(1, 1.0)), b(Noise(1, 1.0))));
}

TEST(ShapeGenerator, IsOfTheKindThatTheModelNames) {
  EXPECT_NE(dynamic_cast<SolidGeneratorImpl*>(MakeGenerator(Solids()).get()), nullptr);
  ModelOptions options = Solids();
  options.kind = ModelKind::kSngan;
  EXPECT_EQ(dynamic_cast<SolidGeneratorImpl*>(MakeGenerator(options).get()), nullptr);
  EXPECT_TRUE(MakeGenerator(options)->HasStatistics());
  EXPECT_FALSE(MakeGenerator(Solids())->HasStatistics());
}

}  // namespace
}  // namespace antigrasp
