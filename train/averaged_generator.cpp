#include "antigrasp/train/averaged_generator.h"

#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>
#include <vector>

#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/generator.h"
#include "antigrasp/models/slices.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kStatisticsBlocks = 32;  // 1,024 samples: a channel's mean to 3 % of its sd

// The share of the components' weight at which sample `i` of many is drawn: n in a row end in all n
// n-ths of it, so that of n components of equal weight none is drawn again before all others were.
class EvenShares {
 public:
  EvenShares(std::int64_t n, double first)
      : n_(n), first_(first), stride_(std::llround(static_cast<double>(n) / std::numbers::phi)) {
    while (std::gcd(stride_, n_) != 1) ++stride_;
  }
  double Of(std::int64_t i) const {
    const double turns = first_ + static_cast<double>(i / n_) / std::numbers::phi;
    const std::int64_t place = i % n_ * stride_ % n_;
    return (static_cast<double>(place) + turns - std::floor(turns)) / static_cast<double>(n_);
  }

 private:
  std::int64_t n_;
  double first_;
  // Near the golden section: few in a row are far from each other as well.
  std::int64_t stride_;
};

torch::Tensor LatentBlock(const LatentMixture& mixture, std::uint64_t seed, std::string_view domain,
                          std::int64_t block) {
  const EvenShares shares(mixture.weights.size(0), RngStream(seed, domain).Uniform());
  std::vector<torch::Tensor> rows;
  for (std::int64_t i = block * kSampleBlock; i < (block + 1) * kSampleBlock; ++i) {
    RngStream rng(seed, domain, static_cast<std::uint64_t>(i));
    rows.push_back(DrawLatent(mixture, shares.Of(i), &rng));
  }
  return torch::stack(rows);
}

// What `of_block` makes of every block that holds samples first to first + count - 1, without the
// others.
template <class OfBlock>
torch::Tensor OfBlocks(std::int64_t first, std::int64_t count, torch::Tensor empty,
                       const OfBlock& of_block) {
  AG_CHECK(first >= 0 && count >= 0, "samples are numbered from 0");
  std::vector<torch::Tensor> parts = {std::move(empty)};
  for (std::int64_t block = first / kSampleBlock; block * kSampleBlock < first + count; ++block) {
    const std::int64_t begin = std::max<std::int64_t>(first - block * kSampleBlock, 0);
    const std::int64_t end = std::min(first + count - block * kSampleBlock, kSampleBlock);
    parts.push_back(of_block(block).slice(0, begin, end).cpu());
  }
  return torch::cat(parts);
}

}  // namespace

torch::Tensor SampleLatents(const LatentMixture& latent, std::uint64_t seed, std::int64_t first,
                            std::int64_t count) {
  return OfBlocks(first, count, torch::empty({0, latent.means.size(1)}),
                  [&](std::int64_t block) { return LatentBlock(latent, seed, "latent", block); });
}

AveragedGenerator::AveragedGenerator(const ModelOptions& options, std::uint64_t seed,
                                     torch::Device device)
    : options_(options), seed_(seed), device_(device), network_(MakeGenerator(options)) {
  network_->to(device_);
}

void AveragedGenerator::Follow(const ShapeGenerator& source, double decay) {
  torch::NoGradGuard no_grad;
  const auto from = source.parameters();
  auto to = network_->parameters();
  if (decay > 0.0 && device_.is_cuda()) {  // few launches for many small tensors
    at::_foreach_mul_(to, decay);
    at::_foreach_add_(to, from, 1.0 - decay);
    statistics_stale_ = true;
    return;
  }
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (decay > 0.0) {
      OnSlices<2>({to[i], from[i]}, [&](auto s) { s[0].lerp_(s[1], 1.0 - decay); });
    } else {
      to[i].copy_(from[i]);
    }
  }
  statistics_stale_ = true;
}

void AveragedGenerator::TakeFolded(AveragedGenerator* other) {
  other->RefreshStatistics();
  dynamic_cast<GeneratorImpl&>(*network_).TakeFolded(
      dynamic_cast<const GeneratorImpl&>(*other->network_));
}

torch::Tensor AveragedGenerator::Sample(const LatentMixture& latent, std::uint64_t seed,
                                        std::int64_t first, std::int64_t count) {
  torch::NoGradGuard no_grad;
  RefreshStatistics();
  network_->eval();
  const std::int64_t r = options_.resolution;
  return OfBlocks(first, count, torch::empty({0, 1, r, r, r}), [&](std::int64_t block) {
    return network_->forward(LatentBlock(latent, seed, "latent", block).to(device_));
  });
}

torch::Tensor AveragedGenerator::Draw(const torch::Tensor& latents) {
  torch::NoGradGuard no_grad;
  RefreshStatistics();
  network_->eval();
  std::vector<torch::Tensor> parts;
  for (const torch::Tensor& block : latents.split(kSampleBlock)) {
    parts.push_back(network_->forward(block.to(device_)).cpu());
  }
  return torch::cat(parts);
}

void AveragedGenerator::RefreshStatistics() {
  if (!statistics_stale_) return;
  statistics_stale_ = false;
  if (!network_->HasStatistics()) return;
  const LatentMixture standard = StandardNormal(options_.latent);
  network_->RestartStatistics();
  network_->train();
  for (std::int64_t block = 0; block < kStatisticsBlocks; ++block) {
    network_->ForwardJudged(LatentBlock(standard, seed_, "statistics", block).to(device_));
  }
}

}  // namespace antigrasp
