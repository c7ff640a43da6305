#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/model_options.h"
#include "antigrasp/models/spectral_norm.h"

namespace antigrasp {

// D : [-1, 1]^{32x32x32} -> R (paper V-A). sdf [pack N, 1, 32, 32, 32] -> score [N],
// or [pack N] when the pack meets in the features. The generator
// mirrored: four convolutions (kernel 4, stride 2) with LeakyReLU 0.2 and a linear head, every
// weight spectrally normalised, no batch norm. A forward in training mode makes one power
// iteration per layer.
class DiscriminatorImpl : public torch::nn::Module {
 public:
  explicit DiscriminatorImpl(const ModelOptions& options);  // weights of a fixed stream
  torch::Tensor forward(const torch::Tensor& sdf);

  // The same for grids folded as folding.h says, [pack N, 8, 17, 17, 17].
  torch::Tensor ForwardFolded(const torch::Tensor& grids);

  void Initialize(RngStream* rng);  // fresh weights

  // The largest of the singular values by which the weights are divided; NaN without spectral norm.
  double LargestSigma();

 private:
  torch::Tensor Refine(std::size_t level, const torch::Tensor& x);
  bool PacksFeatures() const { return options_.pack > 1 && options_.pack_at == "features"; }

  ModelOptions options_;
  std::vector<SpectralWeight> weights_;  // four convolutions, then the head
  std::vector<torch::Tensor> biases_;
  std::vector<SpectralWeight> refine_;  // residual convolutions at 16^3, 8^3, 4^3, or none
};
TORCH_MODULE(Discriminator);

}  // namespace antigrasp
