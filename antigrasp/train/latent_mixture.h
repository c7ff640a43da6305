#pragma once

#include <torch/types.h>

#include <cstdint>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// The distribution of the generator's noise z: a mixture of Gaussians with diagonal covariances,
// float32 on the CPU. N(0, I) (paper V-A) until latent-space CEM moves it.
struct LatentMixture {
  torch::Tensor weights;     // [components], sum 1
  torch::Tensor means;       // [components, latent]
  torch::Tensor deviations;  // [components, latent], > 0
};

// Every component N(0, I), equal weights.
LatentMixture StandardNormal(std::int64_t components, std::int64_t latent);

// z [latent] from a stream: the normals first, then the component, so that equal streams give
// similar z under similar mixtures (common random numbers).
torch::Tensor DrawLatent(const LatentMixture& mixture, RngStream* rng);

// One step of the cross-entropy method (Rubinstein 1999) over z: expectation-maximisation of a
// mixture on the elites [n, latent] from `before`'s component means displaced to distinct elites,
// then `before` and the fit are averaged with weights 1 - smoothing and smoothing, and deviations
// kept above `floor`. A component that no elite prefers keeps its parameters of `before`.
// n >= 1. Cost: kIterations x n x components x latent, milliseconds.
LatentMixture FitToElites(const LatentMixture& before, const torch::Tensor& elites,
                          double smoothing, double floor, RngStream* rng);

}  // namespace antigrasp
