#pragma once

#include <torch/torch.h>

#include "antigrasp/models/model_options.h"

namespace antigrasp {

// D : [-1, 1]^{32x32x32} -> R (paper V-A). sdf [N, 1, 32, 32, 32] -> score [N].
class DiscriminatorImpl : public torch::nn::Module {
 public:
  explicit DiscriminatorImpl(const ModelOptions& options);
  torch::Tensor forward(const torch::Tensor& sdf);

 private:
  ModelOptions options_;
};
TORCH_MODULE(Discriminator);

}  // namespace antigrasp
