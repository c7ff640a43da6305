#include "antigrasp/train/outline_fit.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/error.h"
#include "antigrasp/models/random_tensor.h"
#include "tiny_gan.h"

namespace antigrasp {
namespace {

using tiny_gan::StateOf;
using tiny_gan::Tensors;

ModelOptions Turned() {
  ModelOptions model;
  model.kind = ModelKind::kSolids;
  model.form = PartForm::kTurned;
  model.parts = 2;
  model.width = 2;
  model.latent = 8;
  model.resolution = 16;
  model.squash = Squash::kTanh;
  return model;
}

GanOptions Gan() {
  GanOptions options;
  options.loss = GanLoss::kRelativistic;
  options.gradient_penalty = 1.0;
  options.batch = 8;
  options.fit_share = 0.5;
  return options;
}

// Outlines whose numbers vary by 0.4 about those of a cylinder, as network values.
torch::Tensor Set(std::int64_t n) {
  torch::NoGradGuard no_grad;
  SolidGenerator generator(Turned());
  RngStream rng(2, "outline_fit_test");
  return generator->OfNumbers(NormalTensor({n, generator->PartNumbers()}, 0.4, &rng));
}

TEST(OutlineFit, FindsOfUnseenShapesTheNumbersWhoseSolidsTheyAre) {
  const torch::Tensor all = Set(144), set = all.narrow(0, 0, 128), unseen = all.narrow(0, 128, 16);
  OutlineEncoder encoder(Turned());
  RngStream rng(1, "encoder");
  encoder->Initialize(&rng);
  SolidGenerator generator(Turned());
  OutlineFit fit(Turned(), encoder);
  const auto apart = [&] {
    torch::NoGradGuard no_grad;
    return (generator->OfNumbers(encoder(unseen)) - unseen).square().mean().sqrt().item<double>();
  };
  const double before = apart();
  constexpr int kUpdates = 120;
  double first = 0.0, last = 0.0;
  for (int i = 0; i < kUpdates; ++i) {
    const LossAndGradients found = fit.Gradients(set.narrow(0, 16 * (i % 8), 16), generator.get());
    fit.Take(found.gradients, static_cast<double>(kUpdates - i) / kUpdates);
    last = std::sqrt(found.loss.item<double>());
    if (i == 0) first = last;
  }
  EXPECT_LT(last, 0.5 * first);
  EXPECT_LT(apart(), 0.5 * before);
}

TEST(OutlineFit, ASetThatIsNotFiniteIsSaidAndReachesNoWeight) {
  GanTrainer trainer(Turned(), Gan(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 2, true);
  try {
    trainer.Step(torch::full({2, 1, 16, 16, 16}, NAN));
    FAIL() << "a NaN was accepted";
  } catch (const RuntimeFailure& error) {
    EXPECT_NE(std::string(error.what()).find("step 0"), std::string::npos) << error.what();
  }
  for (const auto& [name, tensor] : StateOf(trainer)) {
    EXPECT_TRUE(tensor.isfinite().all().item<bool>()) << name;
  }
}

TEST(OutlineFit, PartsOfABatchSeeAsManyShapesAsABatch) {
  GanOptions options = Gan();
  options.micro_batches = 4;
  GanTrainer parts(Turned(), options, 5, torch::kCPU);
  parts.BeginEpisode(0, 4, true);
  options.micro_batches = 0;
  GanTrainer whole(Turned(), options, 5, torch::kCPU);
  whole.BeginEpisode(0, 4, true);
  const torch::Tensor one = Set(1).expand({3, 1, 16, 16, 16});  // every batch is this shape
  for (GanTrainer* trainer : {&parts, &whole}) trainer->Step(one);
  const Tensors left = StateOf(parts), right = StateOf(whole);
  for (const auto& [name, tensor] : right) {
    if (!name.starts_with("discriminator/encoder/weight")) continue;
    EXPECT_TRUE(torch::allclose(left.at(name), tensor, 1e-3, 1e-5)) << name;
  }
}

TEST(OutlineFit, TheFirstUpdatesOfNewNetworksFitAndTheOthersLearnWhatWasFound) {
  GanTrainer trainer(Turned(), Gan(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 8, true);
  const torch::Tensor set = Set(12);
  const Tensors fresh = StateOf(trainer);
  const std::string encoder = "discriminator/encoder/", layer = "generator/layer4/weight";
  for (int i = 0; i < 4; ++i) EXPECT_GT(trainer.Step(set).loss_discriminator, 0.0);
  const Tensors fitted = StateOf(trainer);
  EXPECT_FALSE(torch::equal(fitted.at(encoder + "weight1"), fresh.at(encoder + "weight1")));
  EXPECT_TRUE(torch::equal(fitted.at(layer), fresh.at(layer)));
  EXPECT_EQ(fitted.at(encoder + "fitted").item<float>(), 1.0F);
  for (const std::string number : {"mean", "deviation"}) {
    const torch::Tensor& of_set = fitted.at(encoder + number);
    EXPECT_TRUE(torch::equal(fitted.at("generator/" + number), of_set)) << number;
    EXPECT_TRUE(torch::equal(fitted.at("average/" + number), of_set)) << number;
  }
  for (int i = 0; i < 4; ++i) trainer.Step(set);
  trainer.BeginEpisode(1, 4, false);  // nor is it fitted again to what comes later
  for (int i = 0; i < 4; ++i) trainer.Step(set.narrow(0, 0, 5));
  const Tensors later = StateOf(trainer);
  EXPECT_FALSE(torch::equal(later.at(layer), fitted.at(layer)));
  for (const std::string name : {"weight1", "mean", "deviation"}) {
    EXPECT_TRUE(torch::equal(later.at(encoder + name), fitted.at(encoder + name))) << name;
  }
  trainer.BeginEpisode(2, 4, true);  // new networks are
  trainer.Step(set);
  EXPECT_EQ(StateOf(trainer).at(encoder + "fitted").item<float>(), 0.0F);
}

TEST(OutlineFit, ResumedInItsMiddleItGoesOnBitForBit) {
  const torch::Tensor set = Set(12);
  GanTrainer straight(Turned(), Gan(), 5, torch::kCPU);
  straight.BeginEpisode(0, 8, true);
  for (int i = 0; i < 2; ++i) straight.Step(set);
  const Tensors state = StateOf(straight);
  GanTrainer resumed(Turned(), Gan(), 5, torch::kCPU);
  tiny_gan::SetState(state, &resumed);
  for (GanTrainer* trainer : {&straight, &resumed}) {
    for (int i = 0; i < 5; ++i) trainer->Step(set);
  }
  const Tensors left = StateOf(straight), right = StateOf(resumed);
  ASSERT_EQ(left.size(), right.size());
  for (const auto& [name, tensor] : left) {
    EXPECT_TRUE(torch::equal(tensor, right.at(name))) << name;
  }
  EXPECT_TRUE(torch::equal(straight.Sample(1, 0, 3), resumed.Sample(1, 0, 3)));
}

}  // namespace
}  // namespace antigrasp
