#pragma once

#include <torch/nn/module.h>

#include <cstdint>
#include <memory>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/model_options.h"

namespace antigrasp {

// What turns noise into grids: z [N, latent] -> [N, 1, r, r, r], network values (positive inside;
// see ModelOptions::truncation). model.kind says which: generator.h, solid_generator.h.
class ShapeGenerator : public torch::nn::Module {
 public:
  virtual torch::Tensor forward(const torch::Tensor& z) = 0;

  // What the discriminator judges of them: the grids folded as folding.h says, [N, 8, h, h, h], or
  // of turned solids the standardised numbers of their outlines.
  virtual torch::Tensor ForwardJudged(const torch::Tensor& z) = 0;

  virtual void Initialize(RngStream* rng) = 0;  // fresh weights

  // How many numbers z draws a shape by, where forward() takes as many more behind z
  // [N, latent + these], which are added to them; 0 where a shape is drawn node by node.
  virtual std::int64_t PartNumbers() const { return 0; }

  // Whether evaluation uses averages of batches, and the beginning of such an average: from then on
  // every call of forward() in training mode counts, with equal weight.
  virtual bool HasStatistics() const { return false; }
  virtual void RestartStatistics() {}
};

std::shared_ptr<ShapeGenerator> MakeGenerator(const ModelOptions& options);

}  // namespace antigrasp
