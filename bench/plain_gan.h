#pragma once

#include <torch/torch.h>

#include <vector>

#include "antigrasp/models/discriminator.h"
#include "antigrasp/models/generator.h"

namespace antigrasp::bench {

// The two networks and their training step the way one writes them with LibTorch's own modules:
// strided and transposed convolutions on whole grids, torch's batch norm and Adam, spectral norm as
// a few tensor operations. What GanTrainer is measured against.
class PlainGeneratorImpl : public torch::nn::Module {
 public:
  explicit PlainGeneratorImpl(const ModelOptions& options);  // with batch norm and blur
  torch::Tensor forward(const torch::Tensor& z);             // [N, latent] -> [N, 1, 32, 32, 32]
  void CopyFrom(const Generator& generator);

 private:
  std::int64_t width_;
  torch::nn::Linear project_{nullptr};
  std::vector<torch::nn::BatchNorm3d> norms_;
  std::vector<torch::nn::ConvTranspose3d> ups_;
  torch::Tensor blur_;  // [1, 1, 3, 3, 3]
};
TORCH_MODULE(PlainGenerator);

class PlainDiscriminatorImpl : public torch::nn::Module {
 public:
  explicit PlainDiscriminatorImpl(const ModelOptions& options);  // with spectral norm
  torch::Tensor forward(const torch::Tensor& sdf);               // [pack N, 1, 32, 32, 32] -> [N]
  void CopyFrom(const Discriminator& discriminator);

 private:
  torch::Tensor Normalised(std::size_t layer);

  std::int64_t pack_;
  std::vector<torch::Tensor> weights_, biases_, u_;  // four convolutions, then the head
};
TORCH_MODULE(PlainDiscriminator);

// Hinge loss, one forward of G for each of its two uses, an averaged generator.
class PlainTrainer {
 public:
  PlainTrainer(const ModelOptions& options, int batch);
  void Step(const torch::Tensor& shapes);  // one update of D and one of G
  PlainGenerator& average() { return average_; }

 private:
  torch::Tensor Fake();

  std::int64_t latent_, batch_;
  PlainGenerator generator_, average_;
  PlainDiscriminator discriminator_;
  torch::optim::Adam adam_g_, adam_d_;
};

}  // namespace antigrasp::bench
