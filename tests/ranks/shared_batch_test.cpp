#include <gtest/gtest.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "antigrasp/core/error.h"
#include "antigrasp/ranks/ranked_model.h"
#include "antigrasp/train/gan_trainer.h"
#include "tests/ranks/fake_group.h"

namespace antigrasp {
namespace {

// Rows whose float32 sum depends on the order: 1e8, 1, -1e8, 1, 1.
torch::Tensor Rows() {
  return torch::tensor({1e8F, 1.0F, -1e8F, 1.0F, 1.0F}).view({5, 1}).repeat({1, 3});
}

torch::Tensor OwnRows(int rank, int size) {
  std::vector<torch::Tensor> own;
  for (int part = rank; part < 5; part += size) own.push_back(Rows()[part]);
  return own.empty() ? torch::empty({0, 3}) : torch::stack(own);
}

TEST(SharedBatch, AddsTheRowsInTheirOrderForAnyNumberOfRanks) {
  // (1e8 + 1) = 1e8 in float32, - 1e8 = 0, + 1 + 1 = 2; another order gives 3 or 1.
  EXPECT_TRUE(WholeBatch().SumInOrder(Rows(), 5).equal(torch::full({3}, 2.0F)));
  for (const int size : {1, 2, 3, 4, 8}) {
    std::mutex mutex;
    ThreadRanks(size).Run([&](RankGroup* group) {
      if (group->rank() >= 5) return;  // without a part
      const torch::Tensor sum = SharedBatch(group).SumInOrder(OwnRows(group->rank(), size), 5);
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_TRUE(sum.equal(torch::full({3}, 2.0F))) << size << " ranks, rank " << group->rank();
    });
  }
}

ModelOptions SmallModel() {
  ModelOptions model;
  model.width = model.width_d = 4;
  model.latent = 8;
  model.pack = 2;
  return model;
}

GanOptions InParts(int parts) {
  GanOptions options;
  options.batch = 8;
  options.micro_batches = parts;
  options.discriminator_steps = 2;
  return options;
}

NamedTensors AfterThreeSteps(BatchShare* share, int parts) {
  GanTrainer trainer(SmallModel(), InParts(parts), 5, torch::kCPU);
  if (share != nullptr) trainer.ShareBatches(share);
  trainer.BeginEpisode(0, 10, false);
  const torch::Tensor shapes =
      torch::linspace(-1.0, 1.0, 3 * 32 * 32 * 32).view({3, 1, 32, 32, 32}).to(torch::kHalf);
  for (int step = 0; step < 3; ++step) trainer.Step(shapes);
  NamedTensors state;
  for (const auto& [name, tensor] : trainer.State()) state.emplace_back(name, tensor.clone());
  return state;
}

void ExpectEqual(const NamedTensors& a, const NamedTensors& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].first, b[i].first);
    EXPECT_TRUE(a[i].second.equal(b[i].second)) << a[i].first;
  }
}

TEST(SharedBatch, TrainersOfAnyNumberOfRanksHaveTheStateOfOneAlone) {
  const NamedTensors alone = AfterThreeSteps(nullptr, 4);
  for (const int size : {2, 3, 8}) {
    std::mutex mutex;
    std::vector<NamedTensors> states;
    ThreadRanks(size).Run([&](RankGroup* group) {
      if (group->rank() >= 4) return;  // without a part
      SharedBatch share(group);
      NamedTensors state = AfterThreeSteps(&share, 4);
      const std::lock_guard<std::mutex> lock(mutex);
      states.push_back(std::move(state));
    });
    for (const NamedTensors& state : states) ExpectEqual(state, alone);
  }
}

// What stops this rank, and at which step.
std::string Divergence(BatchShare* share, const torch::Tensor& shapes) {
  GanTrainer trainer(SmallModel(), InParts(4), 5, torch::kCPU);
  if (share != nullptr) trainer.ShareBatches(share);
  trainer.BeginEpisode(0, 100, false);
  for (int step = 0; step < 100; ++step) {
    try {
      trainer.Step(shapes);
    } catch (const RuntimeFailure& failure) {
      return failure.what();
    }
  }
  return "nothing";
}

TEST(SharedBatch, ALossThatIsNotFiniteInOnePartStopsAllRanksAtTheSameStep) {
  // One shape of 64 is spoilt: a batch of 8 has it now and then, in one of its four parts.
  torch::Tensor shapes = torch::zeros({64, 1, 32, 32, 32}, torch::kHalf);
  shapes[63] = std::numeric_limits<float>::quiet_NaN();
  const std::string alone = Divergence(nullptr, shapes);
  EXPECT_NE(alone.find("is not finite at step"), std::string::npos) << alone;
  ThreadRanks(4).Run([&](RankGroup* group) {
    SharedBatch share(group);
    EXPECT_EQ(Divergence(&share, shapes), alone) << "rank " << group->rank();
  });
}

TEST(SharedBatch, PartsAreAnotherTrainingThanOnePiece) {
  const NamedTensors two = AfterThreeSteps(nullptr, 2), four = AfterThreeSteps(nullptr, 4);
  bool differ = false;
  for (std::size_t i = 0; i < two.size(); ++i) differ |= !two[i].second.equal(four[i].second);
  EXPECT_TRUE(differ);
}

// Sample i is filled with i, and nothing else of the model is asked.
class Numbered : public ShapeModel {
 public:
  torch::Tensor Sample(std::uint64_t, std::int64_t first, std::int64_t count) override {
    return torch::arange(first, first + count, torch::kFloat)
        .view({count, 1, 1, 1, 1})
        .expand({count, 1, 2, 3, 4})
        .contiguous();
  }
  void BeginEpisode(int, std::int64_t, bool) override {}
  void BeginFixedEpisode(int, const LatentMixture&) override {}
  int episode() const override { return 0; }
  std::int64_t step() const override { return 0; }
  std::int64_t iterations() const override { return 0; }
  void Step(const torch::Tensor&) override {}
  torch::Device device() const override { return torch::kCPU; }
  std::vector<std::string> ScalarNames() const override { return {}; }
  std::vector<double> Scalars() override { return {}; }
  std::string ScalarText() const override { return ""; }
  torch::Tensor Latents(std::uint64_t, std::int64_t, std::int64_t) const override { return {}; }
  const LatentMixture& latent() const override { return latent_; }
  std::int64_t PartNumbers() const override { return 0; }
  torch::Tensor Draw(const torch::Tensor&) override { return {}; }
  NamedTensors State() const override { return {}; }
  void Load(const NamedTensors&, const std::string&) override {}
  void LoadNetworks(const NamedTensors&, const std::string&) override {}

 private:
  LatentMixture latent_;
};

TEST(SampleTogether, RankZeroHasEverySampleInItsPlaceForAnyNumberOfRanks) {
  // 70 samples are three blocks: one rank has two of them, or the last has none.
  for (const int size : {1, 2, 3, 5}) {
    ThreadRanks(size).Run([&](RankGroup* group) {
      Numbered model;
      const torch::Tensor samples = SampleTogether(group, &model, 7, 100, 70);
      if (!group->leads()) return;
      EXPECT_TRUE(samples.equal(model.Sample(7, 100, 70))) << size;
    });
  }
}

TEST(FromLeader, TextStatesAndOrdersArriveAsTheyWere) {
  const NamedTensors state = {{"a/b", torch::arange(6).view({2, 3})}, {"c", torch::tensor(2.5)}};
  ThreadRanks(3).Run([&](RankGroup* group) {
    EXPECT_EQ(group->TextFromLeader(group->leads() ? std::string("x\0y", 3) : ""),
              std::string("x\0y", 3));
    EXPECT_EQ(group->TextFromLeader(""), "");
    ExpectEqual(StateFromLeader(group, group->leads() ? state : NamedTensors()), state);
    const OrderHeader heard =
        TellOrHear(group, group->leads() ? OrderHeader{Order::kSample, -1, 2, 3} : OrderHeader());
    EXPECT_EQ(heard.order, Order::kSample);
    EXPECT_EQ(heard.a, -1);
    EXPECT_EQ(heard.c, 3);
  });
}

}  // namespace
}  // namespace antigrasp
