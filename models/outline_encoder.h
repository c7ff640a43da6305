#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <cstdint>
#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/model_options.h"

namespace antigrasp {

// Of a shape that is round about z the numbers of its outline (turned_outline.h), which training
// fits to a set (train/outline_fit.h): sdf [N, 1, r, r, r] -> [N, n]. It looks at one half of the
// plane nearest to the axis, [r, r / 2] nodes, in which all of such a shape is. Two convolutions
// (kernel 4, stride 2) and three linear layers, LeakyReLU 0.2 between.
class OutlineEncoderImpl : public torch::nn::Module {
 public:
  explicit OutlineEncoderImpl(const ModelOptions& options);
  torch::Tensor forward(const torch::Tensor& sdf);
  void Initialize(RngStream* rng);  // fresh weights, not fitted

  // Forward less the means of a set, by the deviations in it: what networks learn.
  torch::Tensor Standardised(const torch::Tensor& sdf);

  // Ends the fit: takes means and deviations from the set it was fitted to.
  void FittedTo(const torch::Tensor& set);
  bool IsFitted() const;

  const torch::Tensor& mean() const { return mean_; }            // [n]
  const torch::Tensor& deviation() const { return deviation_; }  // [n], no less than 1e-3

 private:
  torch::Tensor fitted_, mean_, deviation_;  // buffers: they are saved with the weights
  std::vector<torch::Tensor> weights_, biases_;
};
TORCH_MODULE(OutlineEncoder);

}  // namespace antigrasp
