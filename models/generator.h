#pragma once

#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/linear.h>

#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/shape_generator.h"

namespace antigrasp {

// G : R^latent -> [-1, 1]^{r x r x r} (paper V-A: r = 32). z [N, latent] -> sdf [N, 1, r, r, r],
// network values (positive inside; see ModelOptions::truncation). The DCGAN shape: a linear layer
// to 2^3 nodes and transposed convolutions (kernel 4, stride 2; four at 32^3), batch norm and ReLU
// between them. Channels double with every halving: 8 c at 2^3 of 32^3, 16 c at 2^3 of 64^3.
class GeneratorImpl : public ShapeGenerator {
 public:
  explicit GeneratorImpl(const ModelOptions& options);  // weights of a fixed stream
  torch::Tensor forward(const torch::Tensor& z) override;

  // The same grid folded as folding.h says: what the discriminator takes, and twice as fast.
  torch::Tensor ForwardJudged(const torch::Tensor& z) override;  // [N, 8, h, h, h], h = r / 2 + 1

  // Fresh weights. Transposed kernels start as trilinear interpolation of a random channel mix and
  // the output far outside, so that the first shapes are smooth and closed.
  void Initialize(RngStream* rng) override;

  // From here on forward() in training mode averages the batch statistics of all its calls with
  // equal weight: run some batches, then eval() samples with them.
  bool HasStatistics() const override { return options_.batch_norm; }
  void RestartStatistics() override;

  // Takes the function that `other` has in evaluation, with its batch statistics, into these
  // networks without batch norm, of equal shape and plain blocks: its scales go into the weights
  // before them, its shifts into the biases. Training then goes on without the noise that a batch's
  // own statistics are.
  void TakeFolded(const GeneratorImpl& other);

  const ModelOptions& options() const { return options_; }

 private:
  torch::Tensor Activate(std::size_t layer, const torch::Tensor& x);
  torch::Tensor Refine(std::size_t level, const torch::Tensor& x);

  ModelOptions options_;
  torch::nn::Linear project_{nullptr};
  std::vector<torch::Tensor> up_weights_;      // [in, out, 4, 4, 4]
  std::vector<torch::nn::BatchNorm3d> norms_;  // one per hidden layer, or instead of them
  std::vector<torch::Tensor> biases_;          // one bias per channel
  std::vector<torch::Tensor>
      refine_weights_;  // residual convolutions at 4^3 ... (r / 2)^3, or none
  std::vector<torch::nn::BatchNorm3d> refine_norms_;
  torch::Tensor last_weight_, last_bias_;
};
TORCH_MODULE(Generator);

}  // namespace antigrasp
