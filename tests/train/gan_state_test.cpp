#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <stdexcept>

#include "antigrasp/models/generator.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/averaged_generator.h"
#include "antigrasp/train/gan_trainer.h"
#include "tests/train/tiny_gan.h"

namespace antigrasp {
namespace {

using tiny_gan::kEmpty;
using tiny_gan::NetworksOf;
using tiny_gan::PlainModel;
using tiny_gan::SetNetworks;
using tiny_gan::SetState;
using tiny_gan::Solids;
using tiny_gan::StateOf;
using tiny_gan::StillOptions;
using tiny_gan::Tensors;

std::vector<std::int64_t> Numbers(const torch::Tensor& tensor) {
  return {tensor.data_ptr<std::int64_t>(), tensor.data_ptr<std::int64_t>() + tensor.numel()};
}

// Equal parameters and buffers to those of the state under this prefix.
void ExpectModule(const torch::nn::Module& module, const std::string& prefix,
                  const Tensors& state) {
  for (const auto& item : module.named_parameters()) {
    std::string name = prefix + item.key();
    std::replace(name.begin(), name.end(), '.', '/');
    EXPECT_TRUE(torch::equal(item.value(), state.at(name))) << name;
  }
}

TEST(GanState, FreshNetworksComeFromTheStreamOfSeedAndEpisode) {
  GanTrainer trainer(PlainModel(), StillOptions(), 5, torch::kCPU);
  for (const int episode : {0, 3}) {
    trainer.BeginEpisode(episode, 2, true);
    RngStream rng(5, "networks", static_cast<std::uint64_t>(episode));
    Generator generator(PlainModel());
    Discriminator discriminator(PlainModel());
    generator->Initialize(&rng);
    discriminator->Initialize(&rng);
    const Tensors state = StateOf(trainer);
    ExpectModule(*generator, "generator/", state);
    ExpectModule(*generator, "average/", state);
    ExpectModule(*discriminator, "discriminator/", state);
  }
}

TEST(GanState, ProgressIsEpisodeIterationsAndStep) {
  GanTrainer trainer(PlainModel(), StillOptions(), 5, torch::kCPU);
  trainer.BeginEpisode(2, 7, false);
  for (int i = 0; i < 3; ++i) trainer.Step(Solids());
  EXPECT_EQ(Numbers(StateOf(trainer).at("progress")), (std::vector<std::int64_t>{2, 7, 3}));
  EXPECT_EQ(Numbers(NetworksOf(trainer).at("progress")), (std::vector<std::int64_t>{2, 7, 3}));
}

TEST(GanState, SamplesAreTheAveragesOfTheLatentStream) {
  GanTrainer trainer(PlainModel(), StillOptions(), 5, torch::kCPU);
  SetNetworks(1.0, -1.0, kEmpty, &trainer);
  Tensors state = StateOf(trainer);
  state["latent/means"].copy_(torch::tensor({{1.0F, 20.0F, -300.0F}}));
  state["latent/deviations"].copy_(torch::tensor({{1.0F, 2.0F, 3.0F}}));
  SetState(state, &trainer);
  Generator average(PlainModel());
  torch::NoGradGuard no_grad;
  for (const auto& item : average->named_parameters()) {
    torch::Tensor target = item.value();
    std::string name = "average/" + item.key();
    std::replace(name.begin(), name.end(), '.', '/');
    target.copy_(state[name]);
  }
  for (const std::uint64_t seed : {8, 9}) {
    std::vector<torch::Tensor> rows;
    for (std::uint64_t i = 40; i < 43; ++i) {
      RngStream rng(seed, "latent", i);
      rows.push_back(torch::tensor({1.0F, 20.0F, -300.0F}) +
                     torch::tensor({1.0F, 2.0F, 3.0F}) * NormalTensor({3}, 1.0, &rng));
    }
    const torch::Tensor z = torch::stack(rows);
    EXPECT_TRUE(torch::equal(trainer.Latents(seed, 40, 3), z));
    EXPECT_TRUE(torch::allclose(trainer.Sample(seed, 40, 3), average(z), 1e-4, 1e-5));
  }
  state["average/last_weight"].zero_();
  state["average/last_bias"].fill_(20.0);
  SetState(state, &trainer);
  EXPECT_TRUE(torch::equal(trainer.Sample(1, 0, 2), torch::ones({2, 1, 32, 32, 32})));
}

TEST(GanState, BatchStatisticsBelongToTheAverageAndToAStreamOfTheirOwn) {
  ModelOptions model = PlainModel();
  model.batch_norm = true;
  GanTrainer trainer(model, StillOptions(), 5, torch::kCPU);
  Tensors state = StateOf(trainer);
  state["generator/project/weight"].fill_(7.0);
  SetState(state, &trainer);
  trainer.Sample(1, 0, 1);
  std::vector<torch::Tensor> rows;
  for (std::uint64_t i = 0; i < 1024; ++i) {
    RngStream rng(5, "statistics", i);
    rows.push_back(NormalTensor({3}, 1.0, &rng));
  }
  const torch::Tensor features =  // 2^3 nodes of each of 16 channels
      torch::stack(rows).matmul(state["average/project/weight"].t()).view({1024, 16, 8});
  state = StateOf(trainer);
  EXPECT_TRUE(torch::allclose(state["average/norm0/running_mean"],
                              features.mean(at::IntArrayRef({0, 2})), 1e-4, 1e-5));
  EXPECT_EQ(state["average/norm0/num_batches_tracked"].item<std::int64_t>(), 32);
  EXPECT_TRUE(torch::equal(state["generator/norm0/running_mean"], torch::zeros({16})));
}

LatentMixture Mixture() {
  return {torch::tensor({0.25F, 0.75F}),
          torch::tensor({{1.0F, 2.0F, 3.0F}, {100.0F, 200.0F, 300.0F}}),
          torch::tensor({{0.1F, 0.2F, 0.3F}, {0.4F, 0.5F, 0.6F}})};
}

TEST(GanState, AFixedEpisodeMovesZAloneAndTakesNoStep) {
  GanTrainer trainer(PlainModel(), StillOptions(), 5, torch::kCPU);
  SetNetworks(1.0, -1.0, kEmpty, &trainer);
  const Tensors before = StateOf(trainer);
  trainer.BeginFixedEpisode(4, Mixture());
  EXPECT_THROW(trainer.Step(Solids()), std::logic_error);
  Tensors after = StateOf(trainer);
  EXPECT_EQ(Numbers(after["progress"]), (std::vector<std::int64_t>{4, 0, 0}));
  EXPECT_TRUE(torch::equal(after["latent/weights"], Mixture().weights));
  EXPECT_TRUE(torch::equal(after["latent/means"], Mixture().means));
  EXPECT_TRUE(torch::equal(after["latent/deviations"], Mixture().deviations));
  for (const auto& [name, tensor] : before) {
    if (name == "progress" || name.starts_with("latent/")) continue;
    EXPECT_TRUE(torch::equal(after[name], tensor)) << name;
  }
  EXPECT_TRUE(torch::equal(trainer.Latents(7, 3, 4), SampleLatents(Mixture(), 7, 3, 4)));

  trainer.BeginEpisode(5, 2, false);  // standard normal again, and an average that begins anew
  after = StateOf(trainer);
  EXPECT_TRUE(torch::equal(after["latent/weights"], torch::ones({1})));
  EXPECT_TRUE(torch::equal(after["latent/means"], torch::zeros({1, 3})));
  EXPECT_TRUE(torch::equal(after["latent/deviations"], torch::ones({1, 3})));
  EXPECT_EQ(after["average/last_bias"].item<double>(), kEmpty);
}

// Every network with numbers of its own, that a half holds.
void TellNetworksApart(GanTrainer* trainer) {
  Tensors state = StateOf(*trainer);
  for (auto& [name, tensor] : state) {
    if (name.starts_with("generator/")) tensor.fill_(1.5);
    if (name.starts_with("average/")) tensor.fill_(2.5);
    if (name.starts_with("discriminator/")) tensor.fill_(3.5);
  }
  SetState(state, trainer);
}

TEST(GanState, SavedNetworksAreTheAverageAndTheDiscriminatorInHalfPrecision) {
  GanTrainer trainer(PlainModel(), StillOptions(), 5, torch::kCPU),
      other(PlainModel(), StillOptions(), 6, torch::kCPU);
  TellNetworksApart(&trainer);
  trainer.BeginFixedEpisode(4, Mixture());
  const Tensors saved = NetworksOf(trainer);
  for (const auto& [name, tensor] : saved) {
    if (name == "progress") continue;
    EXPECT_EQ(tensor.scalar_type(), torch::kHalf) << name;
    if (name.starts_with("latent/")) continue;
    const bool judge = name.starts_with("discriminator/");
    EXPECT_TRUE(judge || name.starts_with("average/")) << name;
    EXPECT_TRUE((tensor == (judge ? 3.5 : 2.5)).all().item<bool>()) << name;
  }
  other.LoadNetworks(tiny_gan::NamedOf(saved), "file.pt");
  for (const auto& [name, tensor] : StateOf(other)) {
    if (name.starts_with("latent/") || name.starts_with("adam") || name == "progress") continue;
    const bool judge = name.starts_with("discriminator/");
    EXPECT_TRUE((tensor == (judge ? 3.5 : 2.5)).all().item<bool>()) << name;
  }
  EXPECT_TRUE(torch::equal(other.latent().means, Mixture().means));
  EXPECT_EQ(other.episode(), 4);
}

TEST(GanState, FoldedNetworksGiveTheSameSamplesAndKeepTheRest) {
  ModelOptions model = PlainModel();
  model.batch_norm = true;
  GanTrainer trainer(model, StillOptions(), 5, torch::kCPU);
  GanTrainer folded(PlainModel(), StillOptions(), 6, torch::kCPU);
  trainer.BeginEpisode(3, 7, true);
  Tensors state = StateOf(trainer);
  state["generator/last_bias"].fill_(9.0);  // not the average's
  SetState(state, &trainer);
  trainer.BeginFixedEpisode(4, Mixture());
  folded.TakeFolded(&trainer);
  EXPECT_LT((folded.Sample(8, 0, 3) - trainer.Sample(8, 0, 3)).abs().max().item<double>(), 1e-3);
  Tensors taken = StateOf(folded);
  for (const auto& [name, tensor] : taken) {
    if (name.starts_with("discriminator/")) {
      EXPECT_TRUE(torch::equal(tensor, state[name])) << name;
    } else if (name.starts_with("average/")) {
      EXPECT_TRUE(torch::equal(tensor, taken["generator/" + name.substr(8)])) << name;
    }
  }
  EXPECT_EQ(Numbers(taken["progress"]), (std::vector<std::int64_t>{4, 0, 0}));
  EXPECT_TRUE(torch::equal(folded.latent().weights, Mixture().weights));
}

}  // namespace
}  // namespace antigrasp
