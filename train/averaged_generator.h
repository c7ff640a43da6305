#pragma once

#include <torch/types.h>

#include <cstdint>
#include <memory>

#include "antigrasp/models/shape_generator.h"
#include "antigrasp/train/latent_mixture.h"

namespace antigrasp {

// Samples are always drawn in whole, aligned blocks of this size, so that the bits of sample i do
// not depend on how many are asked for.
inline constexpr std::int64_t kSampleBlock = 32;

// z of sample `first + i` of stream `seed`, i in [0, count): [count, latent] float32 on the CPU.
// Sample i does not depend on count.
torch::Tensor SampleLatents(const LatentMixture& latent, std::uint64_t seed, std::int64_t first,
                            std::int64_t count);

// The generator that samples are drawn from: the exponential moving average of the one in training
// (Yazici et al., ICLR 2019), with batch statistics that belong to its own weights.
class AveragedGenerator {
 public:
  // `seed`: of the z behind the batch statistics.
  AveragedGenerator(const ModelOptions& options, std::uint64_t seed, torch::Device device);

  // weights = decay * weights + (1 - decay) * source's. 0 copies.
  void Follow(const ShapeGenerator& source, double decay);

  // Takes the function of `other`, which has batch norm, where this one has none.
  void TakeFolded(AveragedGenerator* other);

  // Network values [count, 1, r, r, r] float32 on the CPU of SampleLatents(...).
  torch::Tensor Sample(const LatentMixture& latent, std::uint64_t seed, std::int64_t first,
                       std::int64_t count);

  // Network values [n, 1, r, r, r] float32 on the CPU of latents [n, ...] as SampleLatents gives
  // them.
  torch::Tensor Draw(const torch::Tensor& latents);

  const std::shared_ptr<ShapeGenerator>& network() const { return network_; }
  void WeightsChanged() { statistics_stale_ = true; }  // by someone else

 private:
  void RefreshStatistics();

  ModelOptions options_;
  std::uint64_t seed_;
  torch::Device device_;
  std::shared_ptr<ShapeGenerator> network_;
  bool statistics_stale_ = true;
};

}  // namespace antigrasp
