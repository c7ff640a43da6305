#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "antigrasp/models/folding.h"
#include "antigrasp/models/generator.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/augment.h"
#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/symmetries.h"
#include "tests/train/tiny_gan.h"

namespace antigrasp {
namespace {

using tiny_gan::kEmpty;
using tiny_gan::PlainModel;
using tiny_gan::SetNetworks;
using tiny_gan::Solids;
using tiny_gan::StateOf;
using tiny_gan::StillOptions;
using tiny_gan::Tensors;

TEST(Hinge, LossesAreThoseOfTheScores) {
  GanTrainer trainer(PlainModel(), StillOptions(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 10, true);
  // relu(1 - real) + relu(1 + generated), and -generated.
  for (const auto& [real, generated, loss] : {std::array{2.0, -2.0, 0.0},
                                              {0.0, 2.0, 4.0},
                                              {-1.0, -3.0, 2.0},
                                              {3.0, 1.0, 2.0},
                                              {0.5, -0.25, 1.25}}) {
    SetNetworks(real, generated, kEmpty, &trainer);
    const StepReport report = trainer.Step(Solids());
    EXPECT_NEAR(report.loss_discriminator, loss, 1e-6) << real << ", " << generated;
    EXPECT_NEAR(report.loss_generator, -generated, 1e-6) << real << ", " << generated;
  }
}

TEST(GanStep, UpdatesTheDiscriminatorAsOftenAsAskedAndThenAsksItAgain) {
  GanOptions options = StillOptions();
  options.discriminator_steps = 3;
  options.learning_rate_d = 0.25;
  options.learning_rate_g = 0.125;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 10, true);
  SetNetworks(2.0, 2.0, kEmpty, &trainer);
  const StepReport report = trainer.Step(Solids());
  // The score is the last bias, its gradient 1: it falls by the rate, 2, 1.75, 1.5, 1.25.
  EXPECT_NEAR(report.loss_discriminator, 1.0 + 1.5, 1e-6);
  EXPECT_NEAR(report.loss_generator, -1.25, 1e-6);
  EXPECT_NEAR(report.gradient_discriminator, 1.0, 1e-6);
  EXPECT_EQ(report.gradient_generator, 0.0);
  EXPECT_DOUBLE_EQ(report.rate_discriminator, 0.25);
  EXPECT_DOUBLE_EQ(report.rate_generator, 0.125);
  const Tensors state = StateOf(trainer);
  EXPECT_NEAR(state.at("discriminator/bias5").item<double>(), 1.25, 1e-6);
  EXPECT_EQ(state.at("adam_discriminator/steps").item<std::int64_t>(), 3);
  EXPECT_EQ(state.at("adam_generator/steps").item<std::int64_t>(), 1);
}

TEST(GanStep, TheDiscriminatorRestsWhereItsLossIsBelowWhatWasAsked) {
  GanOptions options = StillOptions();
  options.learning_rate_d = 0.25;
  options.rest_below = 1.25;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 10, true);
  for (const auto& [generated, loss, moves] :
       {std::tuple{0.0, 1.0, false}, {0.25, 1.25, true}, {0.5, 1.5, true}}) {
    SetNetworks(2.0, generated, kEmpty, &trainer);
    const std::int64_t before =
        StateOf(trainer).at("adam_discriminator/steps").item<std::int64_t>();
    const StepReport report = trainer.Step(Solids());
    const Tensors state = StateOf(trainer);
    EXPECT_NEAR(report.loss_discriminator, loss, 1e-6);
    EXPECT_EQ(report.rate_discriminator, moves ? 0.25 : 0.0) << loss;
    EXPECT_NEAR(state.at("discriminator/bias5").item<double>(), generated - (moves ? 0.25 : 0.0),
                1e-6);
    EXPECT_EQ(state.at("adam_discriminator/steps").item<std::int64_t>(), before + (moves ? 1 : 0));
  }
}

TEST(GanStep, MovesTheGeneratorTowardsHigherScores) {
  for (const double slope : {1.0, -1.0}) {
    GanOptions options = StillOptions();
    options.learning_rate_g = 0.125;
    GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
    trainer.BeginEpisode(0, 10, true);
    SetNetworks(slope, -slope, /*output=*/0.0, &trainer);
    trainer.Step(Solids());
    EXPECT_NEAR(StateOf(trainer).at("generator/last_bias").item<double>(), 0.125 * slope, 1e-6);
  }
}

TEST(GanStep, LearningRatesFallToZeroOverTheLastShareOfAnEpisode) {
  struct Case {
    int episode;
    double share;
    std::array<double, 4> factors;
  };
  for (const Case& c : {Case{0, 1.0, {1.0, 0.75, 0.5, 0.25}},
                        {0, 0.5, {1.0, 1.0, 1.0, 0.5}},
                        {0, 0.0, {1.0, 1.0, 1.0, 1.0}},
                        {1, 1.0, {0.5, 0.375, 0.25, 0.125}}}) {
    GanOptions options = StillOptions();
    options.learning_rate_d = 0.25;
    options.learning_rate_g = 0.125;
    options.later_rate = 0.5;
    options.lr_decay_fraction = c.share;
    GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
    trainer.BeginEpisode(c.episode, 4, true);
    SetNetworks(4.0, 4.0, kEmpty, &trainer);
    double bias = 4.0;
    for (const double factor : c.factors) {
      const StepReport report = trainer.Step(Solids());
      EXPECT_DOUBLE_EQ(report.rate_discriminator, 0.25 * factor);
      EXPECT_DOUBLE_EQ(report.rate_generator, 0.125 * factor);
      bias -= 0.25 * factor;  // a gradient of 1
      EXPECT_NEAR(StateOf(trainer).at("discriminator/bias5").item<double>(), bias, 1e-6);
    }
  }
}

TEST(GanStep, EachOptimiserHasItsBetasInTheirPlaces) {
  GanOptions options = StillOptions();
  options.beta1 = 0.6;
  options.beta2 = 0.9;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 4, true);
  SetNetworks(2.0, 2.0, kEmpty, &trainer);
  trainer.Step(Solids());
  const Tensors state = StateOf(trainer);
  // bias5, the fifth parameter of the discriminator, has gradient 1: 1 - 0.6 and 1 - 0.9.
  EXPECT_NEAR(state.at("adam_discriminator/first/4").item<double>(), 0.4, 1e-6);
  EXPECT_NEAR(state.at("adam_discriminator/second/4").item<double>(), 0.1, 1e-6);

  SetNetworks(1.0, -1.0, /*output=*/0.0, &trainer);
  trainer.BeginEpisode(0, 4, false);
  trainer.Step(Solids());
  bool moved = false;
  const Tensors both = StateOf(trainer);
  for (const auto& [name, first] : both) {
    if (!name.starts_with("adam_generator/first/")) continue;
    const torch::Tensor& second = both.at("adam_generator/second" + name.substr(20));
    // 0.1 g^2 and (0.4 g)^2.
    EXPECT_TRUE(torch::allclose(second, first.square() * (0.1 / 0.16), 1e-4, 1e-12)) << name;
    moved = moved || first.abs().max().item<double>() > 0.0;
  }
  EXPECT_TRUE(moved);
}

// Of one step on `average` that is 5 where the generator is about 0: the share of the average kept.
double KeptShare(double ema, std::int64_t iterations, std::int64_t step) {
  GanOptions options = StillOptions();
  options.ema = ema;
  options.learning_rate_g = 0.125;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  SetNetworks(1.0, -1.0, /*output=*/0.0, &trainer);
  Tensors state = StateOf(trainer);
  state["average/last_bias"].fill_(5.0);
  state["progress"] = torch::tensor(std::vector<std::int64_t>{0, iterations, step});
  tiny_gan::SetState(state, &trainer);
  trainer.Step(Solids());
  state = StateOf(trainer);
  const double generator = state["generator/last_bias"].item<double>();
  EXPECT_NEAR(generator, 0.125, 1e-6);
  return (state["average/last_bias"].item<double>() - generator) / (5.0 - generator);
}

TEST(GanStep, TheAverageKeepsItsShareAndTakesTheRestFromTheNewGenerator) {
  EXPECT_NEAR(KeptShare(0.0, 100, 0), 1.0 / 10.0, 1e-6);  // (1 + t) / (10 + t) as it warms up
  EXPECT_NEAR(KeptShare(0.0, 100, 1), 2.0 / 11.0, 1e-6);
  EXPECT_NEAR(KeptShare(0.05, 100, 0), 0.05, 1e-6);
  EXPECT_NEAR(KeptShare(0.6, 100, 90), 0.6, 1e-6);
  EXPECT_NEAR(KeptShare(0.0, 20000, 15000), 0.999, 1e-6);
}

TEST(GanStep, TheWholeAverageFollows) {
  GanOptions options = StillOptions();
  options.learning_rate_g = 0.01;
  GanTrainer trainer(PlainModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 10, true);
  SetNetworks(1.0, -1.0, /*output=*/0.3, &trainer);
  Tensors before = StateOf(trainer);
  trainer.Step(Solids());
  Tensors after = StateOf(trainer);
  int parts = 0;
  for (const auto& [name, average] : after) {
    if (!name.starts_with("average/")) continue;
    const torch::Tensor expected = 0.1 * before[name] + 0.9 * after["generator/" + name.substr(8)];
    EXPECT_TRUE(torch::allclose(average, expected, 1e-6, 1e-7)) << name;
    ++parts;
  }
  EXPECT_EQ(parts, 10);  // project, three and one kernels, four biases and one
}

// The networks of a trainer apart from it.
std::pair<Generator, Discriminator> NetworksApart(const ModelOptions& model, const Tensors& state) {
  Generator generator(model);
  Discriminator discriminator(model);
  torch::NoGradGuard no_grad;
  const auto take = [&](const std::string& prefix, const torch::nn::Module& module) {
    for (const auto& item : module.named_parameters()) {
      std::string name = prefix + item.key();
      std::replace(name.begin(), name.end(), '.', '/');
      torch::Tensor target = item.value();
      target.copy_(state.at(name));
    }
  };
  take("generator/", *generator);
  take("discriminator/", *discriminator);
  return {generator, discriminator};
}

TEST(GanStep, DrawsFromTheStreamOfItsSeedEpisodeAndStepAndShowsBothHalvesAlike) {
  GanOptions options = StillOptions();
  options.augment = Augmentation::kShiftsAndFlips;
  options.symmetries = Symmetries::kAroundZAndUp;
  const ModelOptions model = PlainModel();
  GanTrainer trainer(model, options, 5, torch::kCPU);
  trainer.BeginEpisode(2, 10, true);
  Tensors state = StateOf(trainer);
  for (auto& [name, tensor] : state) {
    if (name.starts_with("discriminator/")) tensor.mul_(5.0);  // scores of about 1
  }
  tiny_gan::SetState(state, &trainer);
  auto [generator, discriminator] = NetworksApart(model, state);
  RngStream grids(1, "grids");
  const torch::Tensor shapes = NormalTensor({7, 1, 32, 32, 32}, 1.0, &grids);
  torch::NoGradGuard no_grad;
  for (const std::uint64_t step : {0, 1}) {
    RngStream rng(5, "gan", 2, step);
    std::vector<torch::Tensor> chosen;
    for (int i = 0; i < 4; ++i) chosen.push_back(shapes[static_cast<std::int64_t>(rng.Below(7))]);
    const torch::Tensor real =
        RandomSymmetries(torch::stack(chosen), Symmetries::kAroundZAndUp, &rng);
    const torch::Tensor generated = generator->ForwardJudged(NormalTensor({4, 3}, 1.0, &rng));
    const torch::Tensor scores =
        discriminator->Score(Augment(torch::cat({Fold(real), generated}), options.augment, &rng));
    const torch::Tensor again = discriminator->Score(Augment(generated, options.augment, &rng));
    const double loss = torch::relu(1 - scores.slice(0, 0, 4)).mean().item<double>() +
                        torch::relu(1 + scores.slice(0, 4, 8)).mean().item<double>();
    EXPECT_GT(scores.std().item<double>(), 0.05);
    torch::AutoGradMode gradients(true);
    const StepReport report = trainer.Step(shapes);
    EXPECT_NEAR(report.loss_discriminator, loss, 1e-5) << step;
    EXPECT_NEAR(report.loss_generator, -again.mean().item<double>(), 1e-5) << step;
  }
}

}  // namespace
}  // namespace antigrasp
