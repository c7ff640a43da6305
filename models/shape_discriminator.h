#pragma once

#include <torch/nn/module.h>

#include <memory>

#include "antigrasp/core/rng.h"
#include "antigrasp/models/model_options.h"

namespace antigrasp {

// What tells shapes of a set from generated ones: discriminator.h by whole grids,
// half_plane_discriminator.h by half a plane of solids that are round about an axis.
class ShapeDiscriminator : public torch::nn::Module {
 public:
  virtual torch::Tensor forward(const torch::Tensor& sdf) = 0;  // [N, 1, r, r, r] -> scores

  // The same for grids folded as folding.h says: [N, 8, h, h, h], h = r / 2 + 1.
  virtual torch::Tensor ForwardFolded(const torch::Tensor& grids) = 0;

  virtual void Initialize(RngStream* rng) = 0;  // fresh weights

  // The power iterations of a forward in training mode, without one: for several forwards in
  // evaluation mode, which then divide by the same.
  virtual void IterateSigma() {}

  // The largest of the singular values by which weights are divided; NaN where none is.
  virtual double LargestSigma();

  // How far a shape may move, norm in network values, for its score to change by its gradient:
  // little beside how far shapes are from each other (some 30), so that few units change sides;
  // many enough that what those add averages out, and far more than rounding.
  virtual double SmallMove() const { return 1.0; }
};

std::shared_ptr<ShapeDiscriminator> MakeDiscriminator(const ModelOptions& options);

}  // namespace antigrasp
