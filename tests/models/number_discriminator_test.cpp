#include "antigrasp/models/number_discriminator.h"

#include <ATen/ATen.h>
#include <gtest/gtest.h>
#include <torch/types.h>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/turned_outline.h"

namespace antigrasp {
namespace {

ModelOptions OfThreeFrusta() {
  ModelOptions options;
  options.kind = ModelKind::kSolids;
  options.form = PartForm::kTurned;
  options.parts = 3;
  options.width = 2;
  return options;
}

torch::Tensor Numbers(std::int64_t n) {
  RngStream rng(8, "number_discriminator_test");
  return NormalTensor({n, OutlineNumbers(3)}, 1.0, &rng);
}

TEST(NumberDiscriminator, EqualsPlainLayers) {
  torch::NoGradGuard no_grad;
  NumberDiscriminator discriminator(OfThreeFrusta());
  const auto weights = discriminator->named_parameters();
  torch::Tensor x = Numbers(3);
  for (const char layer : {'1', '2', '3', '4'}) {
    x = torch::matmul(x, weights[std::string("weight") + layer].t()) +
        weights[std::string("bias") + layer];
    if (layer != '4') x = torch::where(x > 0, x, 0.2 * x);
  }
  EXPECT_TRUE(torch::allclose(discriminator->Score(Numbers(3)), x.squeeze(1), 1e-4, 1e-6));
}

TEST(NumberDiscriminator, JudgesOfShapesWhatTheEncoderSaysStandardised) {
  NumberDiscriminator discriminator(OfThreeFrusta());
  RngStream rng(3, "grids");
  const torch::Tensor grids = NormalTensor({6, 1, 32, 32, 32}, 0.4, &rng).clamp_(-1, 1);
  OutlineEncoder encoder = discriminator->encoder();
  encoder->FittedTo(grids);
  const torch::Tensor judged = discriminator->Judged(grids);
  EXPECT_TRUE(torch::equal(judged, encoder->Standardised(grids)));
  EXPECT_FALSE(judged.requires_grad());  // the encoder is not what a step trains
  // Four layers' weights and biases; the encoder's ten are fitted before.
  EXPECT_EQ(discriminator->Trained().size(), 8U);
  EXPECT_EQ(discriminator->parameters().size(), 18U);
}

TEST(NumberDiscriminator, ShapesOfAPackMeetInTheFeatures) {
  torch::NoGradGuard no_grad;
  ModelOptions options = OfThreeFrusta();
  options.pack = 2;
  NumberDiscriminator discriminator(options);
  const torch::Tensor numbers = Numbers(4);
  const torch::Tensor scores = discriminator->Score(numbers);
  ASSERT_EQ(scores.size(0), 4);  // one a shape, not one a pack
  torch::Tensor other = numbers.clone();
  other[1] = numbers[2];  // another companion for the first, the second pack as it was
  const torch::Tensor change = (discriminator->Score(other) - scores).abs();
  EXPECT_GT(change[0].item<float>(), 0.0F);
  EXPECT_EQ(change[2].item<float>(), 0.0F);
  EXPECT_EQ(change[3].item<float>(), 0.0F);
}

TEST(NumberDiscriminator, JudgesTurnedSolidsAndNoOthers) {
  ModelOptions options = OfThreeFrusta();
  EXPECT_NE(dynamic_cast<NumberDiscriminatorImpl*>(MakeDiscriminator(options).get()), nullptr);
  options.form = PartForm::kBoxes;
  EXPECT_NE(dynamic_cast<DiscriminatorImpl*>(MakeDiscriminator(options).get()), nullptr);
  options.form = PartForm::kTurned;
  options.kind = ModelKind::kSngan;  // whose samples need not be round
  EXPECT_NE(dynamic_cast<DiscriminatorImpl*>(MakeDiscriminator(options).get()), nullptr);
}

TEST(NumberDiscriminator, IsAsWideAsItIsTold) {
  ModelOptions options = OfThreeFrusta();
  const auto units = [&] { return NumberDiscriminator(options)->Trained()[0].size(0); };
  EXPECT_EQ(units(), 64);
  options.width_d = 5;
  EXPECT_EQ(units(), 160);
}

}  // namespace
}  // namespace antigrasp
