#pragma once

#include <ATen/core/Tensor.h>

#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// Independent N(0, sd^2) numbers, float32 on the CPU, drawn in storage order.
at::Tensor NormalTensor(at::IntArrayRef shape, double sd, RngStream* rng);

// Fresh linear and convolutional layers: weights [out, in, ...] of the deviation that LibTorch's
// own begin with, 1 / sqrt(3 inputs), and no bias.
void FreshLayers(std::vector<at::Tensor>* weights, std::vector<at::Tensor>* biases, RngStream* rng);

}  // namespace antigrasp
