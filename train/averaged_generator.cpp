#include "antigrasp/train/averaged_generator.h"

#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/models/generator.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kStatisticsBlocks = 32;  // 1,024 samples: a channel's mean to 3 % of its sd

// The components' weight is gone through by multiples of the golden ratio: any number of samples in
// a row are spread over the components evenly, so that none is drawn again long before others were
// drawn at all.
torch::Tensor LatentBlock(const LatentMixture& mixture, std::uint64_t seed, std::string_view domain,
                          std::int64_t block) {
  const double first = RngStream(seed, domain).Uniform();
  std::vector<torch::Tensor> rows;
  for (std::int64_t i = block * kSampleBlock; i < (block + 1) * kSampleBlock; ++i) {
    RngStream rng(seed, domain, static_cast<std::uint64_t>(i));
    const double turns = first + static_cast<double>(i) / std::numbers::phi;
    rows.push_back(DrawLatent(mixture, turns - std::floor(turns), &rng));
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
      to[i].lerp_(from[i], 1.0 - decay);
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
    network_->ForwardFolded(LatentBlock(standard, seed_, "statistics", block).to(device_));
  }
}

}  // namespace antigrasp
