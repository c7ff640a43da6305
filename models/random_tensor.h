#pragma once

#include <ATen/core/Tensor.h>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// Independent N(0, sd^2) numbers, float32 on the CPU, drawn in storage order.
at::Tensor NormalTensor(at::IntArrayRef shape, double sd, RngStream* rng);

}  // namespace antigrasp
