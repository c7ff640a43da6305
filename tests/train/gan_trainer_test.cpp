#include "antigrasp/train/gan_trainer.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <algorithm>
#include <limits>

#include "antigrasp/core/error.h"
#include "antigrasp/models/few_bends.h"
#include "antigrasp/models/sdf_values.h"

namespace antigrasp {
namespace {

ModelOptions TinyModel() {
  ModelOptions options;
  options.width = 2;
  options.latent = 8;
  return options;
}

ModelOptions TinySolids() {
  ModelOptions options = TinyModel();
  options.kind = ModelKind::kSolids;
  options.parts = 2;
  return options;
}

GanOptions TinyGan() {
  GanOptions options;
  options.batch = 4;
  return options;
}

// Spheres of several radii, as network values.
torch::Tensor Spheres(std::int64_t count) {
  const torch::Tensor axis = torch::linspace(-0.5, 0.5, 32);
  const torch::Tensor distance =
      (axis.view({32, 1, 1}).square() + axis.view({32, 1}).square() + axis.square()).sqrt();
  const torch::Tensor radius = torch::linspace(0.2, 0.4, count).view({count, 1, 1, 1, 1});
  return ((radius - distance.view({1, 1, 32, 32, 32})) / 0.1).clamp(-1, 1);
}

// All tensors of a trainer's state, copied.
NamedTensors Saved(const GanTrainer& trainer) {
  NamedTensors state = trainer.State();
  for (auto& [name, tensor] : state) tensor = tensor.detach().clone();
  return state;
}

void ExpectSameState(const GanTrainer& a, const GanTrainer& b) {
  const auto left = Saved(a), right = Saved(b);
  ASSERT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < left.size(); ++i) {
    EXPECT_EQ(left[i].first, right[i].first);
    EXPECT_TRUE(torch::equal(left[i].second, right[i].second)) << left[i].first;
  }
}

void Train(int steps, const torch::Tensor& shapes, GanTrainer* trainer) {
  for (int i = 0; i < steps; ++i) {
    trainer->Step(shapes);
  }
}

TEST(GanTrainer, SameSeedGivesTheSameBits) {
  const torch::Tensor shapes = Spheres(6);
  GanTrainer a(TinyModel(), TinyGan(), 5, torch::kCPU), b(TinyModel(), TinyGan(), 5, torch::kCPU);
  for (GanTrainer* trainer : {&a, &b}) {
    trainer->BeginEpisode(0, 10, true);
    Train(4, shapes, trainer);
  }
  ExpectSameState(a, b);
  GanTrainer other(TinyModel(), TinyGan(), 6, torch::kCPU);
  EXPECT_FALSE(torch::equal(other.Sample(1, 0, 1), a.Sample(1, 0, 1)));
}

TEST(GanTrainer, ResumingEqualsGoingOnBitForBit) {
  const torch::Tensor shapes = Spheres(6);
  ModelOptions without = TinyModel();
  without.batch_norm = false;
  for (const ModelOptions& model : {TinyModel(), without, TinySolids()}) {
    GanTrainer straight(model, TinyGan(), 5, torch::kCPU);
    straight.BeginEpisode(2, 8, true);
    Train(3, shapes, &straight);
    straight.Sample(1, 0, 2);  // sampling leaves no trace in what follows
    const NamedTensors state = Saved(straight);
    Train(3, shapes, &straight);

    GanTrainer resumed(model, TinyGan(), 5, torch::kCPU);
    resumed.Load(state, "state");
    EXPECT_EQ(resumed.episode(), 2);
    EXPECT_EQ(resumed.iterations(), 8);
    EXPECT_EQ(resumed.step(), 3);
    Train(3, shapes, &resumed);
    EXPECT_TRUE(torch::equal(resumed.Sample(9, 0, 3), straight.Sample(9, 0, 3)));
    ExpectSameState(resumed, straight);
  }
}

TEST(GanTrainer, TheStateHoldsEveryPartByName) {
  GanTrainer trainer(TinyModel(), TinyGan(), 5, torch::kCPU);
  const auto state = Saved(trainer);
  for (const std::string name :
       {"generator/last_weight", "generator/norm0/running_mean", "discriminator/layer1/weight",
        "discriminator/layer5/u", "average/project/weight", "adam_generator/first/0",
        "adam_discriminator/second/0", "adam_generator/steps", "progress"}) {
    EXPECT_TRUE(std::any_of(state.begin(), state.end(), [&](const auto& item) {
      return item.first == name;
    })) << name;
  }
}

TEST(GanTrainer, LoadRefusesAStateThatDoesNotFitAndChangesNothing) {
  GanTrainer trainer(TinyModel(), TinyGan(), 5, torch::kCPU);
  const torch::Tensor before = trainer.Sample(1, 0, 2);

  ModelOptions wider = TinyModel();
  wider.width = 4;
  const NamedTensors wrong_shape = Saved(GanTrainer(wider, TinyGan(), 5, torch::kCPU));
  EXPECT_THROW(trainer.Load(wrong_shape, "state"), InputError);

  ModelOptions plain = TinyModel();
  plain.batch_norm = false;
  const NamedTensors missing = Saved(GanTrainer(plain, TinyGan(), 5, torch::kCPU));
  try {
    trainer.Load(missing, "state");
    FAIL() << "a missing tensor was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("norm0"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(torch::equal(trainer.Sample(1, 0, 2), before));
}

TEST(GanTrainer, SampleDoesNotDependOnHowManyAreAskedFor) {
  for (const ModelOptions& model : {TinyModel(), TinySolids()}) {
    GanTrainer trainer(model, TinyGan(), 5, torch::kCPU);
    trainer.BeginEpisode(0, 4, true);
    Train(2, Spheres(4), &trainer);
    const torch::Tensor all = trainer.Sample(3, 0, 70);
    EXPECT_EQ(all.sizes(), (std::vector<std::int64_t>{70, 1, 32, 32, 32}));
    EXPECT_TRUE(torch::equal(trainer.Sample(3, 33, 1)[0], all[33]));
    EXPECT_TRUE(torch::equal(trainer.Sample(3, 20, 40), all.slice(0, 20, 60)));
    EXPECT_EQ(trainer.Sample(3, 5, 0).size(0), 0);
    EXPECT_FALSE(torch::equal(trainer.Sample(4, 0, 1)[0], all[0]));
  }
}

// In cells of a grid of 32 along a side of 1, by the squash of the model.
TEST(GanTrainer, SamplesWithFairingAreWhatIsDrawnWithFewBends) {
  for (const Squash squash : {Squash::kClamp, Squash::kTanh}) {
    ModelOptions model = TinyModel();
    model.squash = squash;
    GanOptions options = TinyGan();
    options.fairing = 0.7;
    options.fairing_power = 0.2;
    GanTrainer plain(model, TinyGan(), 5, torch::kCPU), fair(model, options, 5, torch::kCPU);
    for (GanTrainer* trainer : {&plain, &fair}) {
      trainer->BeginEpisode(0, 4, true);
      Train(2, Spheres(4), trainer);
    }
    const torch::Tensor drawn = plain.Sample(3, 0, 4), sample = fair.Sample(3, 0, 4);
    const torch::Tensor cells = Distances(drawn, model) * 32.0;
    const torch::Tensor wanted = WithFewBends(cells, {.weight = 0.7, .power = 0.2});
    EXPECT_LT((Distances(sample, model) * 32.0 - wanted).abs().max().item<double>(), 2e-3);
    EXPECT_GT((sample - drawn).abs().max().item<double>(), 1e-3);
    EXPECT_EQ(fair.Sample(3, 0, 0).size(0), 0);
    EXPECT_TRUE(torch::equal(fair.Sample(3, 1, 1)[0], sample[1]));
  }
}

TEST(GanTrainer, HalfPrecisionShapesTrainLikeFloat) {
  GanTrainer half(TinyModel(), TinyGan(), 5, torch::kCPU);
  GanTrainer full(TinyModel(), TinyGan(), 5, torch::kCPU);
  const torch::Tensor shapes = Spheres(4).to(torch::kHalf);
  EXPECT_EQ(half.Step(shapes).loss_discriminator,
            full.Step(shapes.to(torch::kFloat)).loss_discriminator);
}

TEST(GanTrainer, TheFirstLossesAreTheHingeAtScoresNearZero) {
  // Fresh discriminator, scores near 0: L_D = 1 + 1, L_G = 0.
  GanTrainer trainer(TinyModel(), TinyGan(), 5, torch::kCPU);
  const StepReport report = trainer.Step(Spheres(4));
  EXPECT_NEAR(report.loss_discriminator, 2.0, 0.7);
  EXPECT_NEAR(report.loss_generator, 0.0, 0.7);
}

// Trains on a single sphere: the samples' mean error after, by that before.
double ErrorLeft(ModelOptions model) {
  model.width = 4;
  GanOptions options;
  options.batch = 6;
  options.learning_rate_g = options.learning_rate_d = 2e-3;
  GanTrainer trainer(model, options, 5, torch::kCPU);
  const torch::Tensor sphere = Spheres(1);
  trainer.BeginEpisode(0, 60, true);
  const auto error = [&] {
    return (trainer.Sample(1, 0, 16) - sphere).abs().mean().item<double>();
  };
  const double before = error();
  Train(60, sphere, &trainer);
  return error() / before;
}

TEST(GanTrainer, MovesTowardsASingleShape) {
  EXPECT_LT(ErrorLeft(TinyModel()), 0.9);
  EXPECT_LT(ErrorLeft(TinySolids()), 0.9);
}

TEST(GanTrainer, AnEpisodeKeepsTheNetworksAndRestartsTheRest) {
  const torch::Tensor shapes = Spheres(4);
  GanTrainer trainer(TinyModel(), TinyGan(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 3, true);
  Train(3, shapes, &trainer);
  auto before = Saved(trainer);
  trainer.BeginEpisode(1, 5, false);
  EXPECT_EQ(trainer.step(), 0);
  auto after = Saved(trainer);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::string& name = before[i].first;
    if (name.rfind("generator/", 0) == 0 || name.rfind("discriminator/", 0) == 0) {
      EXPECT_TRUE(torch::equal(before[i].second, after[i].second)) << name;
    } else if (name.rfind("adam", 0) == 0) {
      EXPECT_EQ(after[i].second.abs().sum().item<double>(), 0.0) << name;
    }
  }
  trainer.BeginEpisode(1, 5, true);
  EXPECT_FALSE(torch::equal(Saved(trainer)[0].second, before[0].second));
}

TEST(GanTrainer, MoreDiscriminatorStepsAndNoSpectralNormRun) {
  ModelOptions model = TinyModel();
  model.spectral_norm = false;
  GanOptions options = TinyGan();
  options.discriminator_steps = 3;
  GanTrainer trainer(model, options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 2, true);
  Train(2, Spheres(4), &trainer);
  EXPECT_EQ(trainer.step(), 2);
  EXPECT_TRUE(trainer.Sample(1, 0, 4).isfinite().all().item<bool>());
}

TEST(GanTrainer, APackedDiscriminatorTrainsAndItsFirstLossesAreTheHinge) {
  ModelOptions model = TinyModel();
  model.pack = 2;
  GanTrainer trainer(model, TinyGan(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 2, true);
  const StepReport report = trainer.Step(Spheres(4));
  EXPECT_NEAR(report.loss_discriminator, 2.0, 0.7);
  EXPECT_NEAR(report.loss_generator, 0.0, 0.7);
  trainer.Step(Spheres(4));
  EXPECT_TRUE(trainer.Sample(1, 0, 4).isfinite().all().item<bool>());
}

TEST(GanTrainer, LaterEpisodesTrainAtTheirOwnRate) {
  GanOptions options = TinyGan();
  options.later_rate = 0.25;
  options.lr_decay_fraction = 0.0;
  GanTrainer trainer(TinyModel(), options, 5, torch::kCPU);
  trainer.BeginEpisode(0, 2, true);
  EXPECT_DOUBLE_EQ(trainer.Step(Spheres(4)).rate_generator, options.learning_rate_g);
  trainer.BeginEpisode(1, 2, false);
  EXPECT_DOUBLE_EQ(trainer.Step(Spheres(4)).rate_generator, 0.25 * options.learning_rate_g);
}

TEST(GanTrainer, EveryKindOfAugmentationTrains) {
  for (const Augmentation kind :
       {Augmentation::kFlips, Augmentation::kShifts, Augmentation::kShiftsAndFlips}) {
    GanOptions options = TinyGan();
    options.augment = kind;
    ModelOptions model = TinyModel();
    model.batch_norm = false;  // whose statistics take longer than the steps
    GanTrainer trainer(model, options, 5, torch::kCPU);
    trainer.BeginEpisode(0, 2, true);
    trainer.Step(Spheres(4));
    trainer.Step(Spheres(4));
    EXPECT_TRUE(trainer.Sample(1, 0, 4).isfinite().all().item<bool>()) << ChoiceName(kind);
  }
}

TEST(GanTrainer, NotFiniteLossNamesTheStep) {
  GanTrainer trainer(TinyModel(), TinyGan(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 3, true);
  trainer.Step(Spheres(4));
  const torch::Tensor broken =
      torch::full({4, 1, 32, 32, 32}, std::numeric_limits<float>::quiet_NaN());
  try {
    trainer.Step(broken);
    FAIL() << "a NaN was accepted";
  } catch (const RuntimeFailure& error) {
    EXPECT_NE(std::string(error.what()).find("step 1"), std::string::npos) << error.what();
  }
}

TEST(GanTrainer, RefusesStepsBeyondTheEpisodeAndEmptySets) {
  GanTrainer trainer(TinyModel(), TinyGan(), 5, torch::kCPU);
  trainer.BeginEpisode(0, 1, true);
  EXPECT_THROW(trainer.Step(torch::zeros({0, 1, 32, 32, 32})), std::logic_error);
  trainer.Step(Spheres(4));
  EXPECT_THROW(trainer.Step(Spheres(4)), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
