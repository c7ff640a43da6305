#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <vector>

#include "antigrasp/models/shape_discriminator.h"
#include "antigrasp/models/spectral_norm.h"

namespace antigrasp {

// D : [-1, 1]^{r x r x r} -> R (paper V-A: r = 32). sdf [pack N, 1, r, r, r] -> score [N], or
// [pack N] when the pack meets in the features. The generator mirrored: convolutions (kernel 4,
// stride 2; four at 32^3) with LeakyReLU 0.2 down to 2^3 nodes and a linear head, every weight
// spectrally normalised, no batch norm. A forward in training mode makes one power iteration per
// layer.
class DiscriminatorImpl : public ShapeDiscriminator {
 public:
  explicit DiscriminatorImpl(const ModelOptions& options);  // weights of a fixed stream
  torch::Tensor forward(const torch::Tensor& sdf);

  // Grids folded as folding.h says, [pack N, 8, h, h, h], h = r / 2 + 1.
  torch::Tensor Judged(const torch::Tensor& sdf) override;

  torch::Tensor Score(const torch::Tensor& judged) override;
  void Initialize(RngStream* rng) override;
  void IterateSigma() override;
  double LargestSigma() override;  // NaN without spectral norm

 private:
  torch::Tensor Refine(std::size_t level, const torch::Tensor& x);
  bool PacksFeatures() const { return options_.pack > 1 && options_.pack_at == PackAt::kFeatures; }

  ModelOptions options_;
  std::vector<SpectralWeight> weights_;  // convolutions, then the head
  std::vector<torch::Tensor> biases_;
  std::vector<SpectralWeight> refine_;  // residual convolutions at (r / 2)^3 ... 4^3, or none
};
TORCH_MODULE(Discriminator);

}  // namespace antigrasp
