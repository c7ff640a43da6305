#pragma once

#include <memory>
#include <vector>

#include "antigrasp/ranks/rank_group.h"
#include "antigrasp/train/batch_share.h"
#include "antigrasp/train/shape_model.h"

namespace antigrasp {

// Parts of a batch over the n ranks of a group: each adds a slice of all rows in the order of the
// parts, and all gather the slices. Bytes sent a sum of P numbers: 4 P (n - 1) / n (parts / n + 1)
// a rank; with a part a rank as many as plain all-reduce. Ranks beyond the number of parts have
// none and do not train.
class SharedBatch : public BatchShare {
 public:
  explicit SharedBatch(RankGroup* group) : group_(group) {}
  int rank() const override { return group_->rank(); }
  int size() const override { return group_->size(); }
  torch::Tensor SumInOrder(const torch::Tensor& rows, std::int64_t parts) override;

 private:
  RankGroup* group_;
};

// What rank 0 tells the others to do; one header of eight numbers each.
enum class Order : std::int64_t {
  kModel,         // + configuration: a fresh model
  kBeginEpisode,  // episode, iterations, restart
  kLoad,          // + state
  kShapes,        // + training set
  kStep,
  kSample,  // seed, first, count; rank 0 takes the blocks of all
  kScore,   // number of the job + network values
  kPrior,   // + options, and items to make (ranks/made_together.h)
  kRefine,  // + elites, likewise
  kEnd
};
struct OrderHeader {
  Order order = Order::kEnd;
  std::int64_t a = 0, b = 0, c = 0;
};
OrderHeader TellOrHear(RankGroup* group, const OrderHeader& header);  // rank 0 tells

// A state from rank 0; others hand in nothing.
NamedTensors StateFromLeader(RankGroup* group, const NamedTensors& state);

// Samples first to first + count - 1, in blocks of AveragedGenerator that the ranks share: on rank
// 0 all of them, on the others their own.
torch::Tensor SampleTogether(RankGroup* group, ShapeModel* model, std::uint64_t seed,
                             std::int64_t first, std::int64_t count);

// The model of rank 0, whose calls the models of the other ranks repeat (FollowRanks). Where
// batches are not shared (gan.micro_batches = 0), rank 0 trains alone; those that have not trained
// take the state before they sample.
class RankedModel : public ShapeModel {
 public:
  // parts: gan.micro_batches.
  RankedModel(std::unique_ptr<ShapeModel> model, RankGroup* group, std::int64_t parts);

  void BeginEpisode(int episode, std::int64_t iterations, bool restart) override;
  void BeginFixedEpisode(int episode, const LatentMixture& latent) override;
  int episode() const override { return model_->episode(); }
  std::int64_t step() const override { return model_->step(); }
  std::int64_t iterations() const override { return model_->iterations(); }
  void Step(const torch::Tensor& shapes) override;
  torch::Device device() const override { return model_->device(); }
  std::vector<std::string> ScalarNames() const override { return model_->ScalarNames(); }
  std::vector<double> Scalars() override { return model_->Scalars(); }
  std::string ScalarText() const override { return model_->ScalarText(); }
  torch::Tensor Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) override;
  torch::Tensor Latents(std::uint64_t seed, std::int64_t first, std::int64_t count) const override;
  const LatentMixture& latent() const override { return model_->latent(); }
  std::int64_t PartNumbers() const override { return model_->PartNumbers(); }
  torch::Tensor Draw(const torch::Tensor& latents) override { return model_->Draw(latents); }
  NamedTensors State() const override { return model_->State(); }
  void Load(const NamedTensors& state, const std::string& origin) override;
  void LoadNetworks(const NamedTensors& state, const std::string& origin) override;

 private:
  // Who has the state of this model.
  enum class Know { kNobody, kTrainers, kAll };
  bool shares_batches() const { return parts_ > 0; }
  void TellState(Know enough);
  Know AfterTraining() const;

  std::unique_ptr<ShapeModel> model_;
  RankGroup* group_;
  std::int64_t parts_;
  Know know_ = Know::kNobody;
  torch::Tensor told_;  // the training set that the others have
};

}  // namespace antigrasp
