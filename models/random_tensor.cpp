#include "antigrasp/models/random_tensor.h"

#include <ATen/ATen.h>

namespace antigrasp {

at::Tensor NormalTensor(at::IntArrayRef shape, double sd, RngStream* rng) {
  at::Tensor result = at::empty(shape, at::kFloat);
  float* values = result.data_ptr<float>();
  for (std::int64_t i = 0; i < result.numel(); ++i) {
    values[i] = static_cast<float>(sd * rng->Normal());
  }
  return result;
}

}  // namespace antigrasp
