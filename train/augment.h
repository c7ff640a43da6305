#pragma once

#include <torch/types.h>

#include <string>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// Shows the discriminator a batch shifted, mirrored or both: one draw for the whole batch of folded
// grids (folding.h) [N, 8, 17, 17, 17], differentiable. Applied to real and generated shapes alike,
// it keeps the discriminator from learning a small set by heart and does not leak into the samples
// (DiffAugment, Zhao et al., NeurIPS 2020). `kind`: "none" (nothing drawn), "flips" (each axis with
// probability 1/2), "shifts" (up to kLargestShift nodes along each axis, the border repeated),
// "shifts_and_flips".
inline constexpr int kLargestShift = 3;
torch::Tensor Augment(const torch::Tensor& folded, const std::string& kind, RngStream* rng);

}  // namespace antigrasp
