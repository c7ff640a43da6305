#include <gtest/gtest.h>
#include <torch/cuda.h>
#include <torch/types.h>

#include <memory>
#include <utility>

#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/captured_gradients.h"
#include "antigrasp/train/gan_trainer.h"

namespace antigrasp {
namespace {

ModelOptions SmallModel() {
  ModelOptions options;
  options.latent = 16;
  options.pack = 4;
  options.pack_at = PackAt::kFeatures;
  options.edge_gain = 1.0;
  return options;
}

torch::Tensor Grids() {
  RngStream rng(1, "grids");
  return NormalTensor({16, 1, 32, 32, 32}, 0.3, &rng).clamp_(-1.0, 1.0);
}

// Tests of the same trainer on both devices; skipped where there is no GPU.
class Cuda : public testing::Test {
 protected:
  void SetUp() override {
    if (!torch::cuda::is_available()) GTEST_SKIP() << "this LibTorch or this machine has no CUDA";
    at::globalContext().setAllowTF32CuDNN(false);  // 10 bits of mantissa would hide mistakes
    at::globalContext().setAllowTF32CuBLAS(false);
  }
  void TearDown() override { at::globalContext().setAllowTF32CuDNN(true); }

  static std::unique_ptr<GanTrainer> Trainer(torch::Device device, const GanOptions& options = {},
                                             const ModelOptions& model = SmallModel()) {
    auto trainer = std::make_unique<GanTrainer>(model, options, 3, device);
    trainer->BeginEpisode(0, 20, true);
    return trainer;
  }
};

TEST_F(Cuda, StepsLoseAsMuchAsOnTheCpu) {
  const auto cpu = Trainer(torch::kCPU), gpu = Trainer(torch::kCUDA);
  const torch::Tensor shapes = Grids();
  for (int step = 0; step < 5; ++step) {
    const StepReport expected = cpu->Step(shapes), found = gpu->Step(shapes.to(torch::kCUDA));
    EXPECT_NEAR(found.loss_discriminator, expected.loss_discriminator, 2e-3);
    EXPECT_NEAR(found.loss_generator, expected.loss_generator, 2e-3);
    EXPECT_NEAR(found.gradient_generator, expected.gradient_generator,
                2e-2 * expected.gradient_generator);
  }
  EXPECT_NEAR(gpu->LargestSigma(), cpu->LargestSigma(), 1e-3);
}

TEST_F(Cuda, RecordedStepsAreThoseThatAreLaunchedOneByOne) {
  if (!HasCapture()) GTEST_SKIP() << "built without CUDA graphs";
  ModelOptions solids = SmallModel();
  solids.kind = ModelKind::kSolids;
  GanOptions penalised;
  penalised.loss = GanLoss::kRelativistic;
  penalised.gradient_penalty = 1.0;
  for (const auto& [model, options] :
       {std::pair(SmallModel(), GanOptions()), {SmallModel(), penalised}, {solids, penalised}}) {
    GanOptions graphs = options;
    graphs.cuda_graphs = true;
    const auto recorded = Trainer(torch::kCUDA, graphs, model);
    const auto plain = Trainer(torch::kCUDA, options, model);
    const torch::Tensor shapes = Grids().to(torch::kCUDA);
    for (int step = 0; step < 10; ++step) {
      if (step == 7) recorded->Load(plain->State(), "state");  // weights change in place
      const StepReport expected = plain->Step(shapes), found = recorded->Step(shapes);
      EXPECT_NEAR(found.loss_discriminator, expected.loss_discriminator, 5e-3) << step;
      EXPECT_NEAR(found.loss_generator, expected.loss_generator, 5e-3) << step;
    }
  }
}

TEST_F(Cuda, WhatAGpuSavedIsTheSameOnTheCpu) {
  const auto gpu = Trainer(torch::kCUDA), cpu = Trainer(torch::kCPU);
  for (int step = 0; step < 3; ++step) gpu->Step(Grids());
  cpu->Load(gpu->State(), "gpu");
  EXPECT_EQ(cpu->step(), 3);
  EXPECT_LT((cpu->Sample(1, 0, 40) - gpu->Sample(1, 0, 40)).abs().max().item<float>(), 1e-3);
  const StepReport expected = gpu->Step(Grids()), found = cpu->Step(Grids());
  EXPECT_NEAR(found.loss_discriminator, expected.loss_discriminator, 2e-3);
}

TEST_F(Cuda, SamplesDoNotDependOnHowManyAreAsked) {
  const auto gpu = Trainer(torch::kCUDA);
  gpu->Step(Grids());
  const torch::Tensor all = gpu->Sample(7, 0, 70);
  EXPECT_TRUE(torch::equal(all.slice(0, 33, 50), gpu->Sample(7, 33, 17)));
}

}  // namespace
}  // namespace antigrasp
