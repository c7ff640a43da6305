#include "antigrasp/train/gan_losses.h"

#include <gtest/gtest.h>
#include <torch/autograd.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <cmath>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/gan_gradients.h"
#include "antigrasp/train/gan_trainer.h"
#include "tests/train/tiny_gan.h"

namespace antigrasp {
namespace {

using tiny_gan::kEmpty;
using tiny_gan::PlainModel;
using tiny_gan::SetNetworks;
using tiny_gan::Solids;
using tiny_gan::StillOptions;

double Softplus(double x) { return std::log1p(std::exp(x)); }

TEST(GanLosses, RelativisticOnesCompareEachGeneratedShapeWithARealOne) {
  const torch::Tensor real = torch::tensor({1.0, -2.0}), generated = torch::tensor({0.5, 3.0});
  EXPECT_NEAR(DiscriminatorLoss(GanLoss::kRelativistic, real, generated).item<double>(),
              0.5 * (Softplus(-0.5) + Softplus(5.0)), 1e-6);
  EXPECT_NEAR(GeneratorLoss(GanLoss::kRelativistic, real, generated).item<double>(),
              0.5 * (Softplus(0.5) + Softplus(-5.0)), 1e-6);
}

TEST(GanLosses, RelativisticStepsSeeScoresOfBothAndOnlyTheirDifference) {
  GanOptions options = StillOptions();
  options.loss = GanLoss::kRelativistic;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 10, true);
  for (const double shift : {0.0, 3.0}) {
    SetNetworks(2.0 + shift, 0.5 + shift, kEmpty, &trainer);
    const StepReport report = trainer.Step(Solids());
    EXPECT_NEAR(report.loss_discriminator, Softplus(-1.5), 1e-5) << shift;
    EXPECT_NEAR(report.loss_generator, Softplus(1.5), 1e-5) << shift;
  }
}

// score(x) = a x0 + b x1^2 by hand: the gradient is (a, 2 b x1).
TEST(GanLosses, ThePenaltyIsTheMeanSquaredSlope) {
  const torch::Tensor weights =
      torch::tensor({0.75, -0.25}, torch::dtype(torch::kDouble).requires_grad(true));
  const auto score = [&](const torch::Tensor& x) {
    return weights[0] * x.select(1, 0) + weights[1] * x.select(1, 1).square();
  };
  const torch::Tensor x = torch::tensor({{5.0, 2.0}, {1.0, -1.0}}, torch::kDouble).requires_grad_();
  const torch::Tensor scores = score(x);
  const Uphill uphill = StepUphill(x, scores, 1.0);
  const torch::Tensor penalty = GradientPenalty(3.0, scores, score(uphill.shapes), uphill.step);
  // Gradients (.75, -1) and (.75, .5): squares 1.5625 and .8125. The farther moves by 1, so by .8
  // of its gradient; over that way the second terms bend by -.25 * .8 * (1 + .25).
  EXPECT_NEAR(penalty.item<double>(), 3.0 / 2.0 * (1.5625 + 0.8125 - 0.25) / 2.0, 1e-9);
  EXPECT_NEAR((uphill.shapes[0] - x[0]).norm().item<double>(), 1.0, 1e-12);
  const torch::Tensor by_weights = torch::autograd::grad({penalty}, {weights})[0];
  // Of 3 / 4 sum (a^2 + 4 b^2 x1^2): by a 3 a, by b 6 b (4 + 1), but for the bend: 3 / 2 * .8
  // * 1.25.
  EXPECT_NEAR(by_weights[0].item<double>(), 3.0 * 0.75, 1e-9);
  EXPECT_NEAR(by_weights[1].item<double>(), -7.5 + 1.5, 1e-9);
}

// The mean of |gradient|^2 by autograd, at the weights as they are.
double PenaltyOf(DiscriminatorImpl* discriminator, const torch::Tensor& shapes) {
  const torch::Tensor x = shapes.detach().requires_grad_();
  const torch::Tensor score = discriminator->Score(x);
  const torch::Tensor g = torch::autograd::grad({score.sum()}, {x})[0];
  return 0.5 * g.square().sum().item<double>() / static_cast<double>(score.size(0));
}

TEST(GanLosses, ThePenaltysGradientIsThatOfTheNetworksSlope) {
  ModelOptions model = PlainModel();
  Discriminator discriminator(model);
  discriminator->to(torch::kDouble);
  RngStream rng(3, "weights");
  torch::NoGradGuard no_grad;
  for (torch::Tensor& parameter : discriminator->parameters()) {
    parameter.copy_(NormalTensor(parameter.sizes(), 0.005, &rng));
    if (parameter.dim() == 1) parameter.fill_(5.0);  // no unit changes sides: linear
  }
  const torch::Tensor shapes =
      Fold(NormalTensor({4, 1, 32, 32, 32}, 0.3, &rng).clamp_(-1, 1).to(torch::kDouble));
  const auto parameters = discriminator->parameters();
  std::vector<torch::Tensor> gradients;
  {
    const torch::AutoGradMode on(true);
    const torch::Tensor x = shapes.detach().requires_grad_();
    const torch::Tensor score = discriminator->Score(x);
    const Uphill uphill = StepUphill(x, score, 1.0);
    const torch::Tensor penalty =
        GradientPenalty(1.0, score, discriminator->Score(uphill.shapes), uphill.step);
    gradients = torch::autograd::grad({penalty}, parameters, {}, false, false, true);
  }
  // Along the gradient itself, by the difference of penalties on both sides: its squared norm.
  double squares = 0.0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!gradients[i].defined()) gradients[i] = torch::zeros_like(parameters[i]);
    squares += gradients[i].square().sum().item<double>();
  }
  constexpr double kStep = 1e-4;
  const auto at = [&](double step) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      torch::Tensor parameter = parameters[i];
      parameter.add_(gradients[i], step);
    }
    const torch::AutoGradMode on(true);
    const double penalty = PenaltyOf(discriminator.get(), shapes);
    const torch::AutoGradMode off(false);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      torch::Tensor parameter = parameters[i];
      parameter.sub_(gradients[i], step);
    }
    return penalty;
  };
  const double by_difference = (at(kStep) - at(-kStep)) / (2.0 * kStep);
  EXPECT_NEAR(squares, by_difference, 1e-2 * squares);
}

TEST(GanLosses, ASteeperDiscriminatorIsPunishedInAStep) {
  GanOptions options = StillOptions();
  options.gradient_penalty = 4.0;
  options.learning_rate_d = 0.001;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 10, true);
  SetNetworks(20.0, -20.0, /*output=*/0.0, &trainer);
  // The score is 20 times node (0, 0, 0) of every shape: 4 / 2 * 400, and the hinge says 1 of 0.
  EXPECT_NEAR(trainer.Step(Solids()).loss_discriminator, 801.0, 0.1);
  const double slope =
      tiny_gan::StateOf(trainer).at("discriminator/layer5/weight")[0][0].item<double>();
  EXPECT_NEAR(slope, 20.0 - 0.001, 1e-5);
}

}  // namespace
}  // namespace antigrasp
