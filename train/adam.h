#pragma once

#include <torch/types.h>

#include <cstdint>
#include <vector>

namespace antigrasp {

// Adam (Kingma & Ba, "Adam: a method for stochastic optimization", ICLR 2015) with epsilon 1e-8,
// for parameters whose gradients are given, not accumulated. Its state is public tensors, so that
// it is saved and restored by name like the networks.
class Adam {
 public:
  Adam(std::vector<torch::Tensor> parameters, double beta1, double beta2);

  // One update with the gradients in the order of the parameters.
  void Step(const std::vector<torch::Tensor>& gradients, double learning_rate);
  void Restart();  // moments and step count to zero

  const std::vector<torch::Tensor>& parameters() const { return parameters_; }
  const std::vector<torch::Tensor>& first_moments() const { return first_; }
  const std::vector<torch::Tensor>& second_moments() const { return second_; }
  const torch::Tensor& steps() const { return steps_; }  // int64 scalar on the CPU

 private:
  std::vector<torch::Tensor> parameters_, first_, second_;
  torch::Tensor steps_;
  double beta1_, beta2_;
};

}  // namespace antigrasp
