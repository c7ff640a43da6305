#pragma once

#include <torch/types.h>

#include <cstdint>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// The distribution of the generator's noise z: a mixture of Gaussians with diagonal covariances,
// float32 on the CPU. N(0, I) (paper V-A) until latent-space CEM moves it.
struct LatentMixture {
  torch::Tensor weights;     // [components], sum 1
  torch::Tensor means;       // [components, latent], or more (ShapeModel::PartNumbers)
  torch::Tensor deviations;  // as means, >= 0
};

LatentMixture StandardNormal(std::int64_t latent);  // one component

// z [latent] of the component in which `share`, in [0, 1), of the weight ends, by the normals of a
// stream: equal streams give similar z under similar mixtures (common random numbers).
torch::Tensor DrawLatent(const LatentMixture& mixture, double share, RngStream* rng);

// One step of the cross-entropy method (Rubinstein 1999) over z: a kernel density around the elites
// [n, latent], n >= 1. Component i draws sqrt(1 - step^2) elite_i + step N(0, I), 0 < step <= 1, so
// that z of standard normal elites is standard normal again: the generator meets what it was
// trained on. One more component, N(0, I), has `fresh` times the weight of all others together (0:
// absent). A mixture of a few Gaussians fitted by expectation-maximisation hardly moved: 200 elites
// say next to nothing about 200 dimensions.
// Elites may carry numbers of parts behind the first `latent` (ShapeModel::PartNumbers): those are
// drawn as elite_i + part_step N(0, I), those of fresh z as part_step N(0, I).
LatentMixture AroundElites(const torch::Tensor& elites, std::int64_t latent, double step,
                           double part_step, double fresh);

}  // namespace antigrasp
