#pragma once

#include <torch/types.h>

#include "antigrasp/core/rng.h"
#include "antigrasp/train/gan_options.h"

namespace antigrasp {

// Shows the discriminator a batch shifted, mirrored or both: one draw for the whole batch of folded
// grids (folding.h) [N, 8, h, h, h], differentiable. Applied to real and generated shapes alike,
// it keeps the discriminator from learning a small set by heart and does not leak into the samples
// (DiffAugment, Zhao et al., NeurIPS 2020). `kind`: kNone (nothing drawn), kFlips (each axis with
// probability 1/2), kShifts (up to kLargestShift nodes along each axis, the border repeated),
// kShiftsAndFlips.
inline constexpr int kLargestShift = 3;
torch::Tensor Augment(const torch::Tensor& folded, Augmentation kind, RngStream* rng);

}  // namespace antigrasp
