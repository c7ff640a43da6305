#pragma once

#include <torch/types.h>

#include <string>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// Shows each grid of a batch [N, 1, z, y, x] under a random symmetry of the cube that keeps the
// z axis: "none" = as it is (no random numbers drawn); "around_z" = one of the 8 quarter turns
// about z and mirrors in x and y; "around_z_and_up" = those and upside down, 16. Graspability does
// not care which way round an object stands, and the synthetic sets look the same from all sides,
// so that a small set of elites becomes 8 or 16 times as large.
torch::Tensor RandomSymmetries(const torch::Tensor& batch, const std::string& symmetries,
                               RngStream* rng);

}  // namespace antigrasp
