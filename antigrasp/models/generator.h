#pragma once

#include <torch/torch.h>

#include "antigrasp/models/model_options.h"

namespace antigrasp {

// G : R^latent -> [-1, 1]^{32x32x32} (paper V-A). z [N, latent] -> sdf [N, 1, 32, 32, 32], network
// values (positive inside; see ModelOptions::truncation).
class GeneratorImpl : public torch::nn::Module {
 public:
  explicit GeneratorImpl(const ModelOptions& options);
  torch::Tensor forward(const torch::Tensor& z);
  const ModelOptions& options() const { return options_; }

 private:
  ModelOptions options_;
  // ... layers
};
TORCH_MODULE(Generator);

}  // namespace antigrasp
