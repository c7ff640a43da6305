#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <vector>

#include "antigrasp/models/shape_discriminator.h"

namespace antigrasp {

// The discriminator of solids that are round about z (model.form = "turned"): it looks at one half
// of the plane nearest to the axis, [r, r / 2] nodes (z, radius) in which all of such a shape is,
// by two-dimensional convolutions, and at the Laplacian in it, in which edges stand out. What is
// not round it does not notice: for sets that are. sdf [N, 1, r, r, r] -> score [N].
// A convolution of 3^2, then some of 4^2 with stride 2 down to 4 x 2 nodes and two linear layers,
// LeakyReLU 0.2 between; model.width_d (or width) says how wide. Shapes of a pack meet in the features
// at 4 x 2, wherever model.pack_at has them meet; spectral norm and edge_gain say nothing here.
class HalfPlaneDiscriminatorImpl : public ShapeDiscriminator {
 public:
  explicit HalfPlaneDiscriminatorImpl(const ModelOptions& options);  // weights of a fixed stream
  torch::Tensor forward(const torch::Tensor& sdf) override;
  torch::Tensor ForwardFolded(const torch::Tensor& grids) override;
  void Initialize(RngStream* rng) override;
  double SmallMove() const override { return 0.005; }  // shapes are some 4 apart, nearest .5

 private:
  ModelOptions options_;
  std::vector<torch::Tensor> weights_, biases_;  // convolutions, then the two linear layers
};
TORCH_MODULE(HalfPlaneDiscriminator);

}  // namespace antigrasp
