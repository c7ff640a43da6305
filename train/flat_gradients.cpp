#include "antigrasp/train/flat_gradients.h"

namespace antigrasp {

torch::Tensor FlatRow(const torch::Tensor& loss, const std::vector<torch::Tensor>& gradients) {
  const torch::NoGradGuard no_grad;
  std::vector<torch::Tensor> parts = {loss.detach().reshape({1})};
  for (const torch::Tensor& gradient : gradients) parts.push_back(gradient.reshape({-1}));
  return torch::cat(parts).to(torch::kCPU, torch::kFloat);
}

LossAndGradients FromFlatRow(const torch::Tensor& row, const std::vector<torch::Tensor>& like) {
  const torch::NoGradGuard no_grad;
  LossAndGradients out{row[0], {}};
  std::int64_t at = 1;
  for (const torch::Tensor& parameter : like) {
    out.gradients.push_back(
        row.slice(0, at, at + parameter.numel()).view(parameter.sizes()).to(parameter.device()));
    at += parameter.numel();
  }
  return out;
}

}  // namespace antigrasp
