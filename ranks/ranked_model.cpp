#include "antigrasp/ranks/ranked_model.h"

#include <algorithm>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/averaged_generator.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kMostTensors = 10000;

}  // namespace

torch::Tensor SharedBatch::SumInOrder(const torch::Tensor& rows, std::int64_t parts) {
  const torch::NoGradGuard no_grad;
  const std::int64_t n = std::min<std::int64_t>(size(), parts), each = (parts + n - 1) / n;
  AG_CHECK(rank() < n, "ranks without a part do not train");
  const std::int64_t numbers = rows.size(1), slice = (numbers + n - 1) / n;
  // Ranks with a part less send a row that nobody reads.
  torch::Tensor padded = torch::zeros({each, n * slice});
  padded.slice(0, 0, rows.size(0)).slice(1, 0, numbers).copy_(rows);
  const int ranks = static_cast<int>(n);
  const torch::Tensor own =  // [n, each, slice]
      group_->ToEachOfFirst(ranks, padded.view({each, n, slice}).transpose(0, 1));
  torch::Tensor sum = own[0][0].clone();
  for (std::int64_t part = 1; part < parts; ++part) sum.add_(own[part % n][part / n]);
  return torch::cat(group_->AllOfFirst(ranks, sum)).slice(0, 0, numbers);
}

OrderHeader TellOrHear(RankGroup* group, const OrderHeader& header) {
  torch::Tensor numbers = torch::tensor(std::vector<std::int64_t>{
      static_cast<std::int64_t>(header.order), header.a, header.b, header.c});
  group->FromLeader(&numbers);
  const std::int64_t* heard = numbers.data_ptr<std::int64_t>();
  if (heard[0] < 0 || heard[0] > static_cast<std::int64_t>(Order::kEnd)) {
    throw RuntimeFailure("rank 0 sent an order that is none");
  }
  return {static_cast<Order>(heard[0]), heard[1], heard[2], heard[3]};
}

NamedTensors StateFromLeader(RankGroup* group, const NamedTensors& state) {
  std::string names;
  for (const auto& [name, tensor] : state) names += name + "\n";
  names = group->TextFromLeader(names);
  if (std::count(names.begin(), names.end(), '\n') > kMostTensors) {
    throw RuntimeFailure("rank 0 sent more tensors than a model has");
  }
  NamedTensors told;
  std::size_t place = 0;
  for (std::size_t at = 0; at < names.size(); ++place) {
    const std::size_t end = names.find('\n', at);
    const torch::Tensor own = group->leads() ? state[place].second : torch::Tensor();
    told.emplace_back(names.substr(at, end - at), group->TensorFromLeader(own));
    at = end + 1;
  }
  return told;
}

torch::Tensor SampleTogether(RankGroup* group, ShapeModel* model, std::uint64_t seed,
                             std::int64_t first, std::int64_t count) {
  // Whole blocks from first on, but for the last: a part of one costs as much as all of it.
  const std::int64_t n = group->size();
  const std::int64_t blocks = (count + kSampleBlock - 1) / kSampleBlock;
  const std::int64_t each = (blocks + n - 1) / n * kSampleBlock;
  const std::int64_t begin = std::min(group->rank() * each, count);
  const std::int64_t end = std::min(begin + each, count);
  torch::Tensor own = model->Sample(seed, first + begin, end - begin);
  if (!group->leads()) {
    if (end > begin) group->GiveLeader(own.contiguous());
    return own;
  }
  std::vector<std::int64_t> sizes = own.sizes().vec();
  sizes[0] = count;
  torch::Tensor all = torch::empty(sizes, own.options());
  all.slice(0, 0, end).copy_(own);
  own.reset();
  for (std::int64_t rank = 1; rank * each < count; ++rank) {
    torch::Tensor part = all.slice(0, rank * each, std::min((rank + 1) * each, count));
    group->TakeFrom(static_cast<int>(rank), &part);
  }
  return all;
}

RankedModel::RankedModel(std::unique_ptr<ShapeModel> model, RankGroup* group, std::int64_t parts)
    : model_(std::move(model)), group_(group), parts_(parts) {
  AG_CHECK(group_->leads(), "rank 0 leads");
}

void RankedModel::BeginEpisode(int episode, std::int64_t iterations, bool restart) {
  if (shares_batches()) {
    TellState(Know::kTrainers);
    TellOrHear(group_, {Order::kBeginEpisode, episode, iterations, restart ? 1 : 0});
  }
  model_->BeginEpisode(episode, iterations, restart);
  know_ = AfterTraining();
}

void RankedModel::BeginFixedEpisode(int episode, const LatentMixture& latent) {
  model_->BeginFixedEpisode(episode, latent);
  know_ = Know::kNobody;
}

void RankedModel::Step(const torch::Tensor& shapes) {
  if (shares_batches()) {
    TellState(Know::kTrainers);
    if (!told_.defined() || !told_.is_same(shapes)) {
      TellOrHear(group_, {Order::kShapes});
      group_->TensorFromLeader(shapes);
      told_ = shapes;
    }
    TellOrHear(group_, {Order::kStep});
  }
  model_->Step(shapes);
  know_ = AfterTraining();
}

torch::Tensor RankedModel::Sample(std::uint64_t seed, std::int64_t first, std::int64_t count) {
  TellState(Know::kAll);
  TellOrHear(group_, {Order::kSample, static_cast<std::int64_t>(seed), first, count});
  return SampleTogether(group_, model_.get(), seed, first, count);
}

torch::Tensor RankedModel::Latents(std::uint64_t seed, std::int64_t first,
                                   std::int64_t count) const {
  return model_->Latents(seed, first, count);
}

void RankedModel::Load(const NamedTensors& state, const std::string& origin) {
  model_->Load(state, origin);
  know_ = Know::kNobody;
}

void RankedModel::LoadNetworks(const NamedTensors& state, const std::string& origin) {
  model_->LoadNetworks(state, origin);
  know_ = Know::kNobody;
}

// All take the whole state where not enough of them have made it themselves.
void RankedModel::TellState(Know enough) {
  if (know_ >= enough) return;
  TellOrHear(group_, {Order::kLoad});
  StateFromLeader(group_, model_->State());
  know_ = Know::kAll;
}

RankedModel::Know RankedModel::AfterTraining() const {
  if (!shares_batches()) return Know::kNobody;
  return group_->size() <= parts_ ? Know::kAll : Know::kTrainers;
}

}  // namespace antigrasp
