#include "antigrasp/models/random_tensor.h"

#include <ATen/ATen.h>

#include <cmath>

namespace antigrasp {

at::Tensor NormalTensor(at::IntArrayRef shape, double sd, RngStream* rng) {
  at::Tensor result = at::empty(shape, at::kFloat);
  float* values = result.data_ptr<float>();
  for (std::int64_t i = 0; i < result.numel(); ++i) {
    values[i] = static_cast<float>(sd * rng->Normal());
  }
  return result;
}

void FreshLayers(std::vector<at::Tensor>* weights, std::vector<at::Tensor>* biases,
                 RngStream* rng) {
  constexpr double kGain = 0.577;
  for (at::Tensor& weight : *weights) {
    const auto inputs = static_cast<double>(weight[0].numel());
    weight.copy_(NormalTensor(weight.sizes(), kGain / std::sqrt(inputs), rng));
  }
  for (at::Tensor& bias : *biases) bias.zero_();
}

}  // namespace antigrasp
