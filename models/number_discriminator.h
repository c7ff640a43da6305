#pragma once

#include <torch/nn/module.h>
#include <torch/nn/pimpl.h>

#include <vector>

#include "antigrasp/models/outline_encoder.h"
#include "antigrasp/models/shape_discriminator.h"

namespace antigrasp {

// The discriminator of turned solids judges the numbers of their outlines: those that the generator
// draws, and those that an encoder which was fitted to the set gives of its shapes. Latent GANs do
// so with the codes of an autoencoder (Achlioptas et al., ICML 2018); here the decoder is geometry,
// not learnt. Standardised numbers [N, n] -> scores [N]: four linear layers, LeakyReLU 0.2 between;
// shapes of a pack meet in the features of the second, wherever model.pack_at has them meet.
// model.width_d (or width) says how wide; spectral norm says nothing here, edge_gain and depth say
// what the fit of the encoder sees (train/outline_fit.h).
class NumberDiscriminatorImpl : public ShapeDiscriminator {
 public:
  explicit NumberDiscriminatorImpl(const ModelOptions& options);  // weights of a fixed stream
  torch::Tensor Judged(const torch::Tensor& sdf) override;
  torch::Tensor Score(const torch::Tensor& judged) override;
  std::vector<torch::Tensor> Trained() override { return trained_; }
  void Initialize(RngStream* rng) override;           // the encoder as well
  double SmallMove() const override { return 0.01; }  // numbers of two shapes are some 5 apart

  const OutlineEncoder& encoder() const { return encoder_; }

 private:
  ModelOptions options_;
  OutlineEncoder encoder_;
  std::vector<torch::Tensor> weights_, biases_, trained_;
};
TORCH_MODULE(NumberDiscriminator);

}  // namespace antigrasp
