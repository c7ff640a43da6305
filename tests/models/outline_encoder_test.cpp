#include "antigrasp/models/outline_encoder.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/turned_outline.h"

namespace antigrasp {
namespace {

ModelOptions TurnedAt(int resolution) {
  ModelOptions options;
  options.kind = ModelKind::kSolids;
  options.form = PartForm::kTurned;
  options.parts = 3;
  options.resolution = resolution;
  return options;
}

torch::Tensor Grids(std::int64_t n, std::int64_t r = 32) {
  RngStream rng(8, "outline_encoder_test");
  return NormalTensor({n, 1, r, r, r}, 0.4, &rng).clamp_(-1, 1);
}

OutlineEncoder Fresh(const ModelOptions& options) {
  OutlineEncoder encoder(options);
  RngStream rng(9, "outline_encoder_test");
  encoder->Initialize(&rng);
  return encoder;
}

TEST(OutlineEncoder, GivesTheNumbersOfAnOutlineAtEveryResolution) {
  torch::NoGradGuard no_grad;
  for (const int resolution : {16, 32, 64}) {
    OutlineEncoder encoder = Fresh(TurnedAt(resolution));
    const torch::Tensor numbers = encoder(Grids(2, resolution));
    EXPECT_EQ(numbers.sizes(), (std::vector<std::int64_t>{2, OutlineNumbers(3)})) << resolution;
    EXPECT_GT((numbers[0] - numbers[1]).abs().max().item<double>(), 1e-4);
  }
}

TEST(OutlineEncoder, SeesHalfThePlaneNextToTheAxisAndNothingElse) {
  torch::NoGradGuard no_grad;
  OutlineEncoder encoder = Fresh(TurnedAt(32));
  const torch::Tensor grids = Grids(2);
  torch::Tensor elsewhere = Grids(4).narrow(0, 2, 2).clone();
  elsewhere.select(3, 15).narrow(3, 16, 16).copy_(grids.select(3, 15).narrow(3, 16, 16));
  EXPECT_TRUE(torch::equal(encoder(elsewhere), encoder(grids)));
  torch::Tensor touched = grids.clone();
  touched.select(3, 15)[1][0][20][20].neg_();
  EXPECT_TRUE(torch::equal(encoder(touched)[0], encoder(grids)[0]));
  EXPECT_FALSE(torch::equal(encoder(touched)[1], encoder(grids)[1]));
}

TEST(OutlineEncoder, OfTheSetItIsFittedToStandardisedNumbersHaveMeanNoneAndDeviationOne) {
  torch::NoGradGuard no_grad;
  OutlineEncoder encoder = Fresh(TurnedAt(32));
  EXPECT_FALSE(encoder->IsFitted());
  const torch::Tensor set = Grids(300);  // more than one block
  EXPECT_TRUE(torch::equal(encoder->Standardised(set), encoder(set)));
  for (torch::Tensor& weight : encoder->parameters()) weight.mul_(3.0);  // above the least
  encoder->FittedTo(set);
  EXPECT_TRUE(encoder->IsFitted());
  const torch::Tensor numbers = encoder->Standardised(set);
  EXPECT_LT(numbers.mean(0).abs().max().item<double>(), 1e-3);
  EXPECT_LT((numbers.square().mean(0) - 1.0).abs().max().item<double>(), 1e-2);
  const torch::Tensor back = encoder->mean() + encoder->deviation() * numbers;
  EXPECT_TRUE(torch::allclose(back, encoder(set), 1e-4, 1e-5));
  RngStream rng(10, "outline_encoder_test");
  encoder->Initialize(&rng);
  EXPECT_FALSE(encoder->IsFitted());
}

TEST(OutlineEncoder, ANumberThatIsTheSameInAllOfASetIsNotDividedByNothing) {
  torch::NoGradGuard no_grad;
  OutlineEncoder encoder = Fresh(TurnedAt(32));
  const torch::Tensor one = Grids(1);
  encoder->FittedTo(one.expand({5, 1, 32, 32, 32}));
  EXPECT_LT(encoder->Standardised(one).abs().max().item<double>(), 1e-2);
}

}  // namespace
}  // namespace antigrasp
