#pragma once

#include <torch/nn/module.h>

#include <memory>
#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/model_options.h"

namespace antigrasp {

// What tells shapes of a set from generated ones: by their grids (discriminator.h), or turned
// solids by the numbers of their outlines (number_discriminator.h).
class ShapeDiscriminator : public torch::nn::Module {
 public:
  // What it judges of shapes [N, 1, r, r, r], network values, in the form in which the generator's
  // ForwardJudged gives it of its own.
  virtual torch::Tensor Judged(const torch::Tensor& sdf) = 0;
  virtual torch::Tensor Score(const torch::Tensor& judged) = 0;  // [N], or a score a pack

  virtual std::vector<torch::Tensor> Trained() { return parameters(); }  // with the generator

  virtual void Initialize(RngStream* rng) = 0;  // fresh weights

  // The power iterations of a forward in training mode, without one: for several forwards in
  // evaluation mode, which then divide by the same.
  virtual void IterateSigma() {}

  // The largest of the singular values by which weights are divided; NaN where none is.
  virtual double LargestSigma();

  // How far what it judges may move, by its norm, for its score to change by its gradient: little
  // beside how far shapes are from each other (some 30 in network values), so that few units change
  // sides; many enough that what those add averages out, and far more than rounding.
  virtual double SmallMove() const { return 1.0; }
};

std::shared_ptr<ShapeDiscriminator> MakeDiscriminator(const ModelOptions& options);

}  // namespace antigrasp
