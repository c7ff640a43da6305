#pragma once

#include <torch/types.h>

#include "antigrasp/core/rng.h"
#include "antigrasp/train/gan_options.h"

namespace antigrasp {

// Shows each grid of a batch [N, 1, z, y, x] under a random symmetry of the cube that keeps the
// z axis: kNone = as it is (no random numbers drawn); kAroundZ = one of the 8 quarter turns
// about z and mirrors in x and y; kAroundZAndUp = those and upside down, 16. Graspability does
// not care which way round an object stands, and the synthetic sets look the same from all sides,
// so that a small set of elites becomes 8 or 16 times as large.
torch::Tensor RandomSymmetries(const torch::Tensor& batch, Symmetries symmetries, RngStream* rng);

}  // namespace antigrasp
