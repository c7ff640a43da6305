#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// A weight W, seen as the matrix [out, in * k^3], divided by its largest singular value sigma
// (Miyato et al., "Spectral normalization for generative adversarial networks", ICLR 2018).
// sigma = u^T W v by power iteration: each forward in training mode makes one step from the
// persistent u, which is a buffer and is saved with the weights. The gradient flows through W in
// sigma with u and v constant. In eval mode u stays, so forward has no side effect.
class SpectralWeightImpl : public torch::nn::Module {
 public:
  SpectralWeightImpl(at::IntArrayRef shape, bool normalise);
  torch::Tensor forward();  // W / sigma; W itself when `normalise` is off

  // W ~ N(0, sd^2), u random, then 15 power iterations so that the first sigma is close.
  void Initialize(double sd, RngStream* rng);

  void Iterate();  // the step of forward(), alone; nothing when `normalise` is off

  torch::Tensor Sigma();  // the estimate forward() divides by, a differentiable scalar

 private:
  torch::Tensor Matrix() const;

  bool normalise_;
  torch::Tensor weight_, u_;
};
TORCH_MODULE(SpectralWeight);

}  // namespace antigrasp
