#pragma once

#include <torch/types.h>

#include <vector>

namespace antigrasp {

// [loss, every number of the gradients], float32 on the CPU: a part of a batch as one row.
torch::Tensor FlatRow(const torch::Tensor& loss, const std::vector<torch::Tensor>& gradients);

// Back from a row that was divided by the number of parts: gradients of the shapes and on the
// device of `like`.
struct LossAndGradients {
  torch::Tensor loss;  // a scalar
  std::vector<torch::Tensor> gradients;
};
LossAndGradients FromFlatRow(const torch::Tensor& row, const std::vector<torch::Tensor>& like);

}  // namespace antigrasp
