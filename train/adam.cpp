#include "antigrasp/train/adam.h"

#include <ATen/ATen.h>
#include <torch/utils.h>

#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/models/slices.h"

namespace antigrasp {
namespace {

constexpr double kEpsilon = 1e-8;

}  // namespace

Adam::Adam(std::vector<torch::Tensor> parameters, double beta1, double beta2)
    : parameters_(std::move(parameters)),
      steps_(torch::zeros({}, torch::kLong)),
      beta1_(beta1),
      beta2_(beta2) {
  for (const torch::Tensor& parameter : parameters_) {
    first_.push_back(torch::zeros_like(parameter).detach());
    second_.push_back(torch::zeros_like(parameter).detach());
  }
}

void Adam::Step(const std::vector<torch::Tensor>& gradients, double learning_rate) {
  AG_CHECK(gradients.size() == parameters_.size(), "one gradient for each parameter");
  torch::NoGradGuard no_grad;
  steps_.add_(1);
  const double t = static_cast<double>(steps_.item<std::int64_t>());
  const double bias1 = 1.0 - std::pow(beta1_, t), bias2 = 1.0 - std::pow(beta2_, t);
  if (parameters_.front().is_cuda()) {  // few launches for many small tensors
    at::_foreach_mul_(first_, beta1_);
    at::_foreach_add_(first_, gradients, 1.0 - beta1_);
    at::_foreach_mul_(second_, beta2_);
    at::_foreach_addcmul_(second_, gradients, gradients, 1.0 - beta2_);
    std::vector<torch::Tensor> roots = at::_foreach_div(second_, bias2);
    at::_foreach_sqrt_(roots);
    at::_foreach_add_(roots, kEpsilon);
    at::_foreach_addcdiv_(parameters_, first_, roots, -learning_rate / bias1);
    return;
  }
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    OnSlices<4>({parameters_[i], gradients[i], first_[i], second_[i]}, [&](auto s) {
      const auto& [parameter, g, first, second] = s;
      first.mul_(beta1_).add_(g, 1.0 - beta1_);
      second.mul_(beta2_).addcmul_(g, g, 1.0 - beta2_);
      const torch::Tensor root = second.div(bias2).sqrt_().add_(kEpsilon);
      parameter.addcdiv_(first, root, -learning_rate / bias1);
    });
  }
}

void Adam::Restart() {
  steps_.zero_();
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    first_[i].zero_();
    second_[i].zero_();
  }
}

}  // namespace antigrasp
