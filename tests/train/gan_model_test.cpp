#include "antigrasp/train/gan_model.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include "tests/train/tiny_gan.h"

namespace antigrasp {
namespace {

using tiny_gan::StateOf;
using tiny_gan::Tensors;
using tiny_gan::TensorsOf;

ModelOptions Spectral() {
  ModelOptions model = tiny_gan::PlainModel();
  model.spectral_norm = true;
  return model;
}

GanOptions Moving() {
  GanOptions options = tiny_gan::StillOptions();
  options.learning_rate_g = 1e-3;
  options.learning_rate_d = 2e-3;
  return options;
}

Tensors SavedBy(const ShapeModel& model) { return TensorsOf(model.State()); }

void ExpectSame(const Tensors& a, const Tensors& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, tensor] : a) EXPECT_TRUE(torch::equal(tensor, b.at(name))) << name;
}

TEST(GanModel, TrainsAndDrawsAsItsTrainerDoes) {
  GanTrainer trainer(Spectral(), Moving(), 5, torch::kCPU);
  GanModel model(GanTrainer(Spectral(), Moving(), 5, torch::kCPU));
  trainer.BeginEpisode(2, 7, /*restart_networks=*/true);
  model.BeginEpisode(2, 7, /*restart=*/true);
  const torch::Tensor shapes = torch::full({3, 1, 32, 32, 32}, -0.5, torch::kHalf);
  trainer.Step(shapes);
  model.Step(shapes);
  const StepReport r = trainer.Step(shapes);
  model.Step(shapes);
  EXPECT_EQ(model.episode(), 2);
  EXPECT_EQ(model.iterations(), 7);
  EXPECT_EQ(model.step(), 2);
  const std::vector<double> scalars = model.Scalars();
  EXPECT_EQ(scalars,
            (std::vector<double>{r.loss_discriminator, r.loss_generator, r.gradient_discriminator,
                                 r.gradient_generator, r.rate_discriminator, r.rate_generator,
                                 trainer.LargestSigma()}));
  EXPECT_EQ(model.ScalarNames().size(), scalars.size());
  ExpectSame(SavedBy(model), StateOf(trainer));
  EXPECT_TRUE(torch::equal(model.Sample(9, 1, 2), trainer.Sample(9, 1, 2)));
  EXPECT_TRUE(torch::equal(model.Latents(9, 1, 2), trainer.Latents(9, 1, 2)));

  const LatentMixture moved = AroundElites(torch::ones({1, 3}), 3, 0.5, 0.0, 0.0);
  model.BeginFixedEpisode(3, moved);
  EXPECT_EQ(model.iterations(), 0);
  EXPECT_TRUE(torch::equal(model.latent().means, moved.means));
  EXPECT_FALSE(torch::equal(model.Latents(9, 1, 2), trainer.Latents(9, 1, 2)));
}

}  // namespace
}  // namespace antigrasp
